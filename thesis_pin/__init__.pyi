# Robots with closed loops
from .loops.closures import (
    ClosedRobot as ClosedRobot,
    Loop as Loop,
)
from .loops.loading import load as load
from .model.formats.closure_file import ClosureFile as ClosureFile
from .loops.dynamics import (
    ForwardDynamics as ForwardDynamics,
    LoopDynamics as LoopDynamics,
    forward_dynamics as forward_dynamics,
    inverse_dynamics as inverse_dynamics,
    simulate as simulate,
)

# Where any robot can go
from .loops.workspace.mapped import (
    Workspace as Workspace,
    evaluate_workspace as evaluate_workspace,
)

# Robots with feet
from .contacts.balance.dynamics import foot_dynamics as foot_dynamics
from .contacts.balance.result import FootDynamics as FootDynamics
from .contacts.floor import Floor as Floor
from .contacts.soles.finding import find_feet as find_feet
from .contacts.soles.foot import Foot as Foot
from .contacts.standing.placing import (
    Placed as Placed,
    stand as stand,
)
from .report.balance.document import BalanceReport as BalanceReport
from .report.balance.making import balance_report as balance_report

# Motions of any robot
from .loops.motion.files import read_motion as read_motion
from .loops.motion.told import JointMotion as JointMotion
from .report.torque.document import (
    TorqueReport as TorqueReport,
    torque_report as torque_report,
)

# Printed equations
from .audit.derivation.auditing import audit_derivation as audit_derivation

# Servos and motors
from .sizing.catalogue import read_catalogue as read_catalogue
from .sizing.motors import motor_family as motor_family
from .sizing.motors import size_motors as size_motors
from .sizing.motors import smallest_motors as smallest_motors

# Many designs
from .sweep.result import Sweep as Sweep
from .sweep.running.runner import sweep_designs as sweep_designs
from .sweep.shown.choice import Choice as Choice
from .sweep.study import make_designs as make_designs

# Viewer
from .pages.player import write_html as write_html
from .pages.scene import Scene as Scene
from .pages.serving import show as show
from .pages.live.making import (
    show_sliders as show_sliders,
    slider_page as slider_page,
)
from .pages.meshcat.robot import viewer as viewer

# Errors
from .errors import (
    BadInput as BadInput,
    ModelError as ModelError,
    ModelWarning as ModelWarning,
    NoSolution as NoSolution,
    NoSupportForce as NoSupportForce,
    NonPhysicalInertia as NonPhysicalInertia,
    NotFinite as NotFinite,
    SingularPose as SingularPose,
    SpecificationError as SpecificationError,
    ThesisPinError as ThesisPinError,
    TrajectoryError as TrajectoryError,
    Undecidable as Undecidable,
    UnknownName as UnknownName,
    Unreachable as Unreachable,
    WrongShape as WrongShape,
)

__version__: str
