"""Every tolerance that decides something, by name and with its unit.

What tells a right line of a thesis from a wrong one belongs to the audits and stands
with their verdicts: :data:`thesis_pin.audit.rows.HOLDS`.
"""

from __future__ import annotations

from typing import NamedTuple

GRAVITY: float = 9.81
"""Size of gravity, Pinocchio's default [m/s²]. Source: Scout thesis, 4.1; Pollard thesis, 3.3."""


class Tolerances(NamedTuple):  # a dataclass of so many fields takes three times as long to make
    """Thresholds used by the library; messages name the one they applied.

    Attributes:
        rotation_orthogonality: Largest entry of RᵀR − 1 accepted in a pose [-].
        singular: Sine or ratio below which a direction counts as undefined [-].
        near_singular: The same, below which rates are refused [-].
        reach: Excess of distance still taken as touching the boundary [m].
        loop_closure: Distance at which a loop counts as closed [m].
        loop_motion: Rate and acceleration of its opening still taken as none,
            relative to 1 + the largest joint rate or acceleration [-].
        model: Relative difference between Pinocchio's model and our own sums [-].
        rank: Singular value, relative to the largest, below which a matrix has
            lost rank [-].
        stance_drift: How far a foot in support may stray from rest or floor [m]: floors
            aren't flatter, and a servo's step of 0.09° moves the hip by three times that.
        stance_tilt: The same of its angles [rad]: 0.1 mm over a sole of a decimetre.
        exact_move: Error of accelerations made of samples below which these count as exact
            [m/s²]: 0.01 mm of a walker's ZMP, whose centre of mass is 0.2 m high.
        exact_turn: The same of angular accelerations [rad/s²].
        exact_rate: The same of rates [m/s], [rad/s]: a joint that rests must not seem to
            turn, or all of its Coulomb friction counts.
        outlier_move: Acceleration that a single sample beside its neighbours would take, from
            which it counts as wrong [m/s²]: slower corners may be meant.
        outlier_turn: The same of angular accelerations [rad/s²].
        node_step: Time between rows [s] from which they are nodes, each of them meant, and what
            scatters about a smooth curve is motion rather than noise: nobody writes more by hand.
        stance_near: How far from its place a foot may be that a log's first or last row of
            a stance has standing: a switch under the sole closes that early [m].
        stance_near_tilt: The same of its angles [rad].
        kept_turn: How far a frame may stand otherwise than a table says once and for all, where the
            robot has no motor for that [rad]: angles written to a tenth of a degree.
        sole_misfit: How far from its place joint angles may put a standing sole: servos of 1°
            and legs of 0.3 m make 5 mm; another robot, or degrees for radians, more [m].
        sole_misfit_tilt: The same of its angles [rad].
        inertia_unfelt: Largest acceleration of a whole motion in which inertia plays no part:
            it moves the zero-moment point of a robot of 0.2 m by 2 µm [m/s²], [rad/s²].
        far_turned: Angle in radians from which a table is asked whether it is in degrees: tools
            turn as they need, but seldom by more than once [rad].
        far_away: Length in metres from which a table is asked whether it is in millimetres: both
            robots would be lost in a hall of that size [m].
        moves: Travel from which something moves rather than trembles [m], [rad].
        joint_limit: Excess still taken as inside a joint limit [rad].
        sole_tilt: Tilt of a sole in the neutral pose below which it counts as level: what
            constant angles rounded to half a degree may leave [rad].
        kind_angle: How far axes may be from parallel or right angles in a file of a biped that is
            still taken as of Scout's kind: a right angle of four digits is 2e-4 off [rad].
        kind_gap: The same of axes that meet, relative to the leg's length [-].
        density: More than any body has: that of osmium [kg/m³].
        slender: Length of a body in radii of gyration that nobody builds; a uniform rod has
            3.5, one with 200 times its own mass at one end 50 [-].
        narrow: Range of joints that would be some degrees if all of them had it: radians
            written as degrees, for a whole turn is 2π [rad].
        overload: Weight times length of the limbs in the strongest actuator's torque, beyond
            which nothing stands [-]; robots that walk have 2 to 20.
        branch_tie: Difference of two branches' distance from the neutral pose below which
            neither is the nearer; less than a hobby servo's dead band [rad].
        seam: Jump of value accepted where segments of a curve meet [m], [rad].
        turned_curve: How far angles of a body that is turned about the vertical may be off between
            the knots of their new curves [rad]: a ten-thousandth of what a standing sole may tilt.
        rate_jump: Jump of rate that counts as smooth [m/s], [rad/s]: spread over a servo's
            period of 10 ms it moves the zero-moment point of a robot of 0.2 m by 0.2 mm.
        closed_acceleration: Jump of acceleration where a cycle begins anew that isn't told
            [m/s²]: 1 mm of the zero-moment point of a robot of 0.2 m.
        closed_turning: The same of its angles [rad/s²].
        rest_rate: Rate at which a gait still begins or ends at rest [m/s]: to stop it a robot
            of 0.2 m needs 0.1 mm of its soles.
        rest_turning: The same of its angles [rad/s].
        step: Least distance of two nodes or samples: below it, rates are made of
            rounding [s], [-].
        static: Joint speed below which Coulomb friction is taken as zero [rad/s], and a foot's
            speed [m/s, rad/s] below which it lands at rest.
        creeping: The same of motions smoothed within their samples' resolution [rad/s], [m/s],
            where friction counts as possible: curves ring that fast where a joint comes to rest,
            and a hobby servo takes two seconds for its smallest step.
        wrench: Distance outside a sole's wrench cone, forces scaled to moments, still
            taken as on its border, where a quadratic programme stops [N·m].
        contact: The same of any robot, relative to its weight times its feet's size [-]: what is
            left over by rounding of a motion's numbers.
        facet: Distance beyond a facet that rounding makes of a wrench on it [N·m].
        impulse: Impulse of a landing still taken as none: what the robot's weight gives in
            this time [s]; it is that of a landing at about 1 mm/s.
        clearance: Depth of a swinging sole's corner below the floor still taken as
            touching it [m]: floors aren't flatter.
        scrape_height: Height below which a sole that moves over the floor scrapes [m]:
            carpets, sagging servos and seams are that high.
        scrape_share: Share of its way over the floor that a foot may make so low: it leaves
            and meets the floor moving [-].
        scrape_way: Way over the floor below which a foot goes straight up and down [m].
        sole_gap: Distance at which two soles touch [m], as :attr:`clearance`.
        sole_face: How far above a link's lowest point its shapes still belong to the sole [m]:
            meshes of soles are no flatter.
        sole_width: Width below which what is lowest of a link is a point or an edge [m]: a
            ball of 5 cm has 14 mm within ``sole_face``.
        foot_height: How much higher than the lowest link others may end that are taken for
            feet too, relative to the robot's height [-].
        balance: How far the zero-moment point may be beyond what bears load in a report's verdict
            [m], as a moment that is missing times the weight: nobody knows soles, points of
            contact or the centre of mass better.
        touching: How far a standing foot's corners may be from one plane, or from the floor,
            without being told [m]: floors aren't flatter.
        touch_height: Height of a foot, relative to that of the centre of mass, below which it is
            on the floor if it is slow: a swinging foot of a walker gets ten times as high [-].
        touch_speed: Its speed, relative to that of a fall from that height, below which it
            rests: feet swing ten times as fast [-].
        slide: Way of a foot that bears load, between landing and leaving, beyond which it slides
            [m]: rubber gives as much, and tables say a sample too early that a foot landed.
        nearer: Difference [m] by which one pair of soles must be nearer to be told from another:
            where feet stand, all samples are alike but for rounding.
        parallel: Squared sine of the angle below which two edges are parallel.
        spelled: Rounding of a cosine or an angle of round numbers, relative to one or a turn;
            what is written drops it [-].
        instant: What counts as just before or after a change of a gait, relative to the
            time the gait or phase takes [-].
        path_end: How far beyond a path's ends a time still means them, relative to the
            path's duration [-].
        path_join: Jump of pose or rate where two paths meet, still taken as none
            [m], [rad], [m/s], [rad/s].
        path_corner: Angle between the directions of two pieces of a path, below which the motion
            needn't stop where they meet [rad]: a tool at 1 m/s jumps by 1 µm/s there.
        law_share: What a law of motion may use beyond a limit between the places of its grid [-].
        law_way: How far a written law's way may be off its path's, as a share: what rounding to six
            digits makes of it [-].
        straight: Area that three points span, relative to the square of their largest
            distance from the first, below which they lie on a line [-].
        on_circle: How far rounding may throw a double root off the unit circle [-].
        half_turn: How near to half a turn two rotations may be until the shorter way between
            them is anyone's guess [rad].
        quaternion_length: Difference from 1 of a quaternion's length still taken as rounding
            of its four numbers, to two decimals [-].
        same_curve: Difference of two splines through the same samples, and of their
            derivatives, relative to the largest value [-].
        same_mode: Angles nearer than this are one assembly mode [rad].
        vanishing: Coefficient relative to the largest, or determinant over squared
            lengths, that is replaced before one divides by it [-], [m²].
        time_unit: Relative width of the interval in which the fastest time unit counts as
            found [-].
        mirror: Relative difference of speeds, shares of a servo or jumps that counts as none:
            of two legs that do the same only rounding would name one [-].
        unbalanced: Force or moment an explicit model may leave over: above rounding,
            below anything physical [N], [N·m].
        determined: Scaled singular value below which motors don't determine passive rates
            [rad]: loops close to 1e-15, so that a pose is known to 1e-15 / σ there, and
            rates to 1e-15 / σ² [-].
        explicit_rank: Singular value of an explicit model's equations, relative to the
            largest, taken as zero [-].
        sheet_rounding: By how much a data sheet may differ from itself in another unit, of the
            larger: 0.06 s in 60° and 0.064 are both 0.06 [-].
        slow_servo: No-load speed below which nothing of a robot's joint is: a turn takes 20 s; the
            seconds in 60° of usual servos, read as rad/s, are less [rad/s].
        motor_torque: Relative width of the interval in which the stall torque of the smallest motor
            counts as found [-]: nobody makes or measures motors better.
        settled_torque: Relative change of the stall torque of the smallest motors for a path that a
            grid of half the steps may make and counts as none [-].
        walking_torque: As ``motor_torque``, where a walk is planned anew with each servo [-]: plans
            are local answers, and not found more exactly.
        power_density, torque_density: Greatest power and stall torque of an actuator for its
            size that are taken for right [W/m³], [N·m/m³]; hobby servos have 0.02 to 0.6 W/cm³
            and up to 0.15 N·m/cm³.
        specific_power, specific_torque: The same for its mass [W/kg], [N·m/kg]; the best
            have 400 W/kg and 80 N·m/kg.
        widest_length: Largest tolerance of a length that is taken for one [m]: a 16th of an arm.
        finest_length: Widest tolerance of a robot's lengths below which one is asked for their unit
            [m]: gauge blocks are made so.
        widest_angle: The same as ``widest_length`` of an angle [rad]: ten degrees.
        linear: Share by which exact kinematics at the worst errors may differ from what is linear
            in them until it is told [-]: nobody knows tolerances better.
        replay_deviation: How far a replayed motion's tool may be from its path [m]: spray and
            servos know no better.
        replay_turn: The same of its orientation [rad]: half a servo's usual accuracy of 1°.
        replay_lost: How far off its path a tool is that isn't replaying it any more, where a replay
            ends [m]: what follows is a fall.
        replay_opening: How far an engine's loops may open [m], a thousandth of what the tool may be
            off, and play of good ball joints.
        replay_energy: How far work and change of energy may differ, relative to the work
            exchanged [-]: engines of order four do a hundred times better.
        plan_share: What a report may find of a limit beyond what a plan was to keep, relative [-]:
            plans are checked at other instants than their reports are.
        plan_margin: The same of the margin [m].
        walked_share, walked_place: How far a simulated walk's distance may be off the planned one,
            relative to it [-], and that of what is to stay in place [m].
        walked_heading: The same of its heading at the end [rad].
        walked_slip: The same of a foot while it bears load, in every step [m].
        walked_tilt: Tilt of the torso from the plan that is no longer the planned motion [rad].
        bearing: Share of its weight from which a robot's sole bears load; less is a foot that
            brushes the floor [-].
        raised: Planned height of a sole's lowest corner from which it is to be off the floor [m].
    """

    rotation_orthogonality: float = 1e-9
    singular: float = 1e-12
    near_singular: float = 1e-8
    reach: float = 1e-12
    loop_closure: float = 1e-9
    loop_motion: float = 1e-7
    model: float = 1e-9
    rank: float = 1e-9
    stance_drift: float = 1e-4
    stance_tilt: float = 1e-3
    exact_move: float = 5e-4
    exact_turn: float = 1e-2
    exact_rate: float = 1e-7
    outlier_move: float = 0.05
    outlier_turn: float = 0.5
    node_step: float = 0.1
    stance_near: float = 1e-3
    stance_near_tilt: float = 1e-2
    kept_turn: float = 2e-3
    sole_misfit: float = 1e-2
    sole_misfit_tilt: float = 1e-1
    inertia_unfelt: float = 1e-4
    far_turned: float = 6.3
    far_away: float = 50.0
    moves: float = 1e-3
    joint_limit: float = 1e-9
    sole_tilt: float = 5e-3
    kind_angle: float = 1e-3
    kind_gap: float = 1e-3
    density: float = 22_600.0
    slender: float = 50.0
    narrow: float = 0.11
    overload: float = 200.0
    branch_tie: float = 1e-3
    seam: float = 1e-4
    turned_curve: float = 1e-7
    rate_jump: float = 1e-4
    closed_acceleration: float = 0.05
    closed_turning: float = 0.5
    rest_rate: float = 1e-3
    rest_turning: float = 1e-2
    step: float = 1e-9
    static: float = 1e-9
    creeping: float = 1e-3
    wrench: float = 1e-7
    contact: float = 1e-9
    facet: float = 1e-10
    impulse: float = 1e-4
    clearance: float = 1e-4
    scrape_height: float = 1e-3
    scrape_share: float = 0.2
    scrape_way: float = 1e-3
    sole_gap: float = 1e-4
    sole_face: float = 1e-3
    sole_width: float = 0.02
    foot_height: float = 0.03
    balance: float = 1e-3
    touching: float = 1e-3
    touch_height: float = 5e-3
    touch_speed: float = 1e-2
    slide: float = 2e-3
    nearer: float = 1e-9
    parallel: float = 1e-12
    spelled: float = 1e-12
    instant: float = 1e-9
    path_end: float = 1e-9
    path_join: float = 1e-9
    path_corner: float = 1e-6
    law_share: float = 0.01
    law_way: float = 1e-5
    straight: float = 1e-9
    on_circle: float = 1e-2
    half_turn: float = 1e-6
    quaternion_length: float = 1e-2
    same_curve: float = 1e-7
    same_mode: float = 1e-6
    vanishing: float = 1e-14
    time_unit: float = 1e-5
    mirror: float = 1e-9
    unbalanced: float = 1e-8
    determined: float = 1e-6
    explicit_rank: float = 1e-11
    sheet_rounding: float = 0.1
    slow_servo: float = 0.3
    motor_torque: float = 5e-4
    settled_torque: float = 4e-3
    walking_torque: float = 0.01
    power_density: float = 1e6
    torque_density: float = 3e5
    specific_power: float = 600.0
    specific_torque: float = 120.0
    widest_length: float = 0.02
    finest_length: float = 1e-6
    widest_angle: float = 0.17453292519943295
    linear: float = 0.05
    replay_deviation: float = 1e-3
    replay_turn: float = 1e-2
    replay_lost: float = 0.05
    replay_opening: float = 1e-6
    replay_energy: float = 1e-6
    plan_share: float = 0.01
    plan_margin: float = 2e-4
    walked_share: float = 0.05
    walked_place: float = 2e-3
    walked_heading: float = 0.0873  # 5°
    walked_slip: float = 1e-3
    walked_tilt: float = 0.175  # 10°
    bearing: float = 0.05
    raised: float = 2e-3


TOLERANCES = Tolerances()
