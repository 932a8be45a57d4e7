# Specification
from .specification import (
    JOINT_NAMES as JOINT_NAMES,
    JOINT_SYMBOLS as JOINT_SYMBOLS,
    Specification as Specification,
)

# Model
from .model import (
    PACKAGE_PATH as PACKAGE_PATH,
    URDF_PATH as URDF_PATH,
    Scout as Scout,
    load as load,
)

# Kinematics
from .kinematics.branches import BRANCHES as BRANCHES
from .kinematics.solutions import LegSolutions as LegSolutions

# Motion
from .motion.gait import Gait as Gait
from .motion.files import load_gait as load_gait
from .motion.cycles import repeat_gait as repeat_gait
from .motion.trajectory import joint_trajectory as joint_trajectory

# Dynamics
from .dynamics.inverse import inverse_dynamics as inverse_dynamics
from .dynamics.stream import torque_blocks as torque_blocks

# Report
from .report.document import gait_report as gait_report

# Study
from .study.size import size as size
from .study.sweeping.making import gait_study as gait_study
from .study.smallest.asking import smallest_motors as smallest_motors
from .study.smallest.asking import time_with_motors as time_with_motors
from .study.smallest.servos import motor_family as motor_family
from .study.smallest.walking import servos_for_walk as servos_for_walk
from .study.simulate.draws import simulate_gait as simulate_gait

# Viewer
from .report.drawn.viewer import viewer as viewer

# Only Scout
from .study.plan.planning import plan_gait as plan_gait
from .study.sweeping.making import plan_study as plan_study
from .study.plan.request import PlanRequest as PlanRequest
from .study.plan.results.result import Plan as Plan
from .kinematics.rates import leg_rates as leg_rates
from .model import Contact as Contact
from .dynamics.impact import touchdown_impact as touchdown_impact
from .dynamics.stability import (
    pressure_point as pressure_point,
    support_margin as support_margin,
    zero_moment_point as zero_moment_point,
)

__version__: str
