"""The load step of load-step.toml in Exudyn: a row of time, speed and tensions a sample.

The belt is a ring of ANCF cables in contact with two circles by penalties, with bristles for friction. The radius of the
circles is raised by what the contact gives way under the tension at rest, so that the belt lies at the radius of the
drive there.

    python load_step.py ELEMENTS STEP CONTACT_STIFFNESS >samples.csv

ELEMENTS of the belt, STEP in s, CONTACT_STIFFNESS in N/m per length. Processor time of the solver goes to standard error.
"""

import sys
import time

sys.exudynFast = True  # the module without range checks

import exudyn as exu
import numpy as np
from exudyn.beams import CreateReevingCurve, PointsAndSlopes2ANCFCable2D
from exudyn.utilities import (
    Cable2D,
    CoordinateConstraint,
    LoadCoordinate,
    MarkerBodyCable2DShape,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    NodeGenericData,
    NodePointGround,
    NodeRigidBody2D,
    ObjectContactFrictionCircleCable2D,
    ObjectRigidBody2D,
)

ELEMENTS = int(sys.argv[1])
STEP = float(sys.argv[2])
CONTACT = float(sys.argv[3])
SEGMENTS = 4  # of each element in contact
ITERATIONS = 5  # of the active set

MASS, AXIAL, DAMPING = 0.1036, 80068.0, 0.1
BENDING = 1e-4  # N m^2: moves no tension by more than 0.02 N at this radius
FRICTION, BRISTLES = 1.2, 2.0e8
RADIUS, CENTRES, INERTIA = 0.08125, 0.25, 0.005
STRETCH = 1.00545
SPEED, RAMP = 120.0, (0.005, 0.055)
LOAD, LOADED = 30.0, 0.1
END, SAMPLE = 0.15, 5e-4


def speed(t):
    """Speed of the driver, rad/s."""
    share = (t - RAMP[0]) / (RAMP[1] - RAMP[0])
    return SPEED * min(max(share, 0.0), 1.0)


container = exu.SystemContainer()
mbs = container.AddSystem()
tension = AXIAL * (STRETCH - 1.0)
curve = CreateReevingCurve(
    [[[0.0, 0.0], RADIUS, "L"], [[CENTRES, 0.0], RADIUS, "L"]],
    radialOffset=0.0,
    closedCurve=True,
    numberOfANCFnodes=ELEMENTS,
)
# The element lengths are those at rest, stretched from a length without tension.
cable = Cable2D(
    physicsMassPerLength=MASS / STRETCH,
    physicsBendingStiffness=BENDING,
    physicsAxialStiffness=AXIAL * STRETCH,
    physicsAxialDamping=DAMPING * STRETCH,
    physicsReferenceAxialStrain=1.0 / STRETCH - 1.0,
    strainIsRelativeToReference=0.0,
    useReducedOrderIntegration=2,
)
belt = PointsAndSlopes2ANCFCable2D(mbs, curve["ancfPointsSlopes"], curve["elementLengths"], cable)
elements = belt[1]
lengths = np.array(curve["elementLengths"])
segment = lengths.mean() / SEGMENTS
ground = mbs.AddNode(NodePointGround())
fixed = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
wheels = []
for number, centre in enumerate([0.0, CENTRES]):
    node = mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[centre, 0.0, 0.0]))
    body = mbs.AddObject(ObjectRigidBody2D(physicsMass=1.0, physicsInertia=INERTIA, nodeNumber=node))
    wheels.append(node)
    for coordinate in [0, 1]:
        marker = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=coordinate))
        mbs.AddObject(CoordinateConstraint(markerNumbers=[fixed, marker]))
    turning = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
    if number == 0:
        mbs.AddLoad(
            LoadCoordinate(
                markerNumber=turning,
                load=0.0,
                loadUserFunction=lambda mbs, t, load: -LOAD if t > LOADED else 0.0,
            )
        )
    else:
        mbs.AddObject(
            CoordinateConstraint(
                markerNumbers=[fixed, turning],
                velocityLevel=True,
                offsetUserFunction_t=lambda mbs, t, item, offset: speed(t),
            )
        )
    circle = mbs.AddMarker(MarkerBodyRigid(bodyNumber=body))
    for element in elements:
        shape = mbs.AddMarker(MarkerBodyCable2DShape(bodyNumber=element, numberOfSegments=SEGMENTS))
        data = [0.1] * SEGMENTS + [-2.0] * SEGMENTS + [0.0] * SEGMENTS
        state = mbs.AddNode(NodeGenericData(initialCoordinates=data, numberOfDataCoordinates=3 * SEGMENTS))
        mbs.AddObject(
            ObjectContactFrictionCircleCable2D(
                markerNumbers=[circle, shape],
                nodeNumber=state,
                numberOfContactSegments=SEGMENTS,
                contactStiffness=CONTACT * segment,
                # Half of the critical damping of the belt on its contact.
                contactDamping=np.sqrt(CONTACT * MASS) * segment,
                frictionStiffness=BRISTLES / STRETCH * segment,
                frictionVelocityPenalty=0.0,
                frictionCoefficient=FRICTION,
                circleRadius=RADIUS + tension / RADIUS / CONTACT,
            )
        )

middles = np.array([[0.5 * CENTRES, -RADIUS], [0.5 * CENTRES, RADIUS]])
rows = []


def sample(mbs, t):
    """Takes a row where a sample is due; the two tensions are those of the cables in the middles of the spans."""
    if t + 0.5 * STEP < len(rows) * SAMPLE:
        return True
    nodes = [mbs.GetNodeOutput(node, exu.OutputVariableType.Position)[:2] for node in belt[0][:ELEMENTS]]
    nodes = np.array(nodes)
    tensions = []
    for middle in middles:
        along = middle[0] - nodes[:, 0]
        ahead = np.roll(nodes[:, 0], -1) - nodes[:, 0]
        share = along / np.where(ahead == 0.0, 1.0, ahead)
        on_side = nodes[:, 1] * middle[1] > 0.0
        index = int(np.flatnonzero((share >= 0.0) & (share < 1.0) & on_side)[0])
        place = [share[index] * lengths[index], 0.0, 0.0]
        force = mbs.GetObjectOutputBody(elements[index], exu.OutputVariableType.ForceLocal, place)
        tensions.append(float(np.atleast_1d(force)[0]))
    omega = mbs.GetNodeOutput(wheels[0], exu.OutputVariableType.AngularVelocity)[2]
    rows.append([t, omega, *tensions])
    return True


mbs.SetPreStepUserFunction(sample)
mbs.Assemble()
settings = exu.SimulationSettings()
settings.linearSolverType = exu.LinearSolverType.EigenSparse
settings.solutionSettings.writeSolutionToFile = False
settings.solutionSettings.sensorsWritePeriod = 1.0
settings.timeIntegration.numberOfSteps = round(END / STEP)
settings.timeIntegration.endTime = END
settings.timeIntegration.verboseMode = 0
settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
settings.timeIntegration.newton.useModifiedNewton = True
settings.timeIntegration.discontinuous.iterationTolerance = 1e-3
settings.timeIntegration.discontinuous.maxIterations = ITERATIONS
settings.timeIntegration.stepInformation = 8
settings.displayStatistics = False
began = time.process_time()
mbs.SolveDynamic(settings, solverType=exu.DynamicSolverType.TrapezoidalIndex2)
spent = time.process_time() - began
print("time,speed,tight,slack")
for row in rows:
    print(",".join(f"{number:.9g}" for number in row))
print(f"{spent:.2f} s of processor time with {ELEMENTS} elements, Exudyn {exu.GetVersionString()}", file=sys.stderr)
