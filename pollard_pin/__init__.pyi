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
    Pollard as Pollard,
    load as load,
)

# Kinematics
from .kinematics.geometry import (
    ALL_BRANCHES as ALL_BRANCHES,
    DEFAULT_BRANCH as DEFAULT_BRANCH,
    USEFUL_BRANCHES as USEFUL_BRANCHES,
    Branch as Branch,
)

# Motion
from .motion.path import ToolPath as ToolPath
from .motion.files import load_path as load_path
from .motion.trajectory import joint_trajectory as joint_trajectory

# Dynamics
from .dynamics.inverse import inverse_dynamics as inverse_dynamics
from .dynamics.stream import torque_blocks as torque_blocks

# Report
from .report.document import trajectory_report as trajectory_report

# Study
from .study.size import size as size
from .study.sweeping.making import path_study as path_study
from .study.sweeping.making import time_study as time_study
from .study.smallest.asking import smallest_motors as smallest_motors
from .study.smallest.asking import time_with_motors as time_with_motors
from .study.smallest.motors import motor_family as motor_family
from .study.simulate.draws import simulate_path as simulate_path

# Viewer
from .report.drawn.viewer import viewer as viewer

# Only Pollard
from .specification import ACTUATOR_NAMES as ACTUATOR_NAMES
from .model import CLOSURE_PATH as CLOSURE_PATH
from .motion.curves import appendix_b as appendix_b
from .dynamics.inverse import inverse_dynamics_at as inverse_dynamics_at
from .dynamics.three_motors import three_torques as three_torques
from .motion.placing import Placement as Placement, place_path as place_path
from .study.workspace import evaluate_workspace as evaluate_workspace
from .study.placement.search import evaluate_placements as evaluate_placements
from .study.accuracy.study import (
    path_accuracy as path_accuracy,
    workspace_accuracy as workspace_accuracy,
)
from .study.accuracy.files import read_tolerances as read_tolerances
from .study.timing.limits import motor_limits as motor_limits
from .study.timing.timed import time_path as time_path

__version__: str
