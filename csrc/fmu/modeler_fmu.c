/* FMI 3.0 around the dynamics of a robot: model exchange, and co-simulation by Runge-Kutta's steps.
 *
 * fmu_model.h says which robot. Its values stand in one array: a value reference is a place there.
 * Memory is taken when an instance, or a copy of its state, is made; nothing is global.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"
#include "fmu_model.h"

#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-parameter" /* FMI prescribes what nobody here reads. */
#endif

enum { N = FMU_JOINTS, STATES = 2*FMU_JOINTS };

/* Places of the values; q and qd are the states, dq and qdd their derivatives. */
enum {
    TIME = 0,
    STEP = 1,
    Q = 2,
    QD = Q + N,
    DQ = QD + N,
    QDD = DQ + N,
    TAU = QDD + N,
    BETA = TAU + N,
    WIDTH = BETA + FMU_BETA,
    VALUES = WIDTH + FMU_WIDTHS
};

/* What fmi3GetFMUState keeps. */
typedef struct {
    double value[VALUES];
    bool running; /* initial values are set */
    bool current; /* dq and qdd belong to the other values */
} robot_state;

typedef struct {
    robot_state now;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
} robot_instance;

static fmi3Status told(const robot_instance *robot, fmi3Status status, const char *message)
{
    if (robot->log != NULL) {
        robot->log(robot->environment, status, status == fmi3Discard ? "discarded" : "error",
                   message);
    }
    return status;
}

static void started(robot_state *now)
{
    memset(now, 0, sizeof *now);
    now->value[STEP] = FMU_STEP;
    memcpy(now->value + Q, fmu_home, sizeof fmu_home);
    memcpy(now->value + BETA, fmu_beta, sizeof fmu_beta);
    for (int i = 0; i < FMU_WIDTHS; i++) {
        now->value[WIDTH + i] = FMU_WIDTH;
    }
}

/* Derivatives of the states. */
static fmi3Status derived(robot_instance *robot)
{
    double *x = robot->now.value;
    if (robot->now.current != false) {
        return fmi3OK;
    }
    int status = fmu_accelerations(x + Q, x + QD, x + TAU, x + BETA, x + WIDTH, x + QDD);
    for (int i = 0; i < N && status == MODELER_DONE; i++) {
        status = isfinite(x[QDD + i]) ? MODELER_DONE : MODELER_NOT_FINITE;
    }
    if (status != MODELER_DONE) {
        char text[96];
        snprintf(text, sizeof text, "no accelerations at time %g: status %d of %s", x[TIME],
                 status, FMU_FUNCTION);
        return told(robot, fmi3Discard, text);
    }
    memcpy(x + DQ, x + QD, N*sizeof *x);
    robot->now.current = true;
    return fmi3OK;
}

/* One step of the classical method of fourth order, torques constant. */
static fmi3Status stepped(robot_instance *robot, double h)
{
    static const double ahead[3] = {0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    double *x = robot->now.value, start[STATES], sum[STATES] = {0.0};
    memcpy(start, x + Q, sizeof start);
    for (int stage = 0; stage < 4; stage++) {
        fmi3Status status = derived(robot);
        if (status != fmi3OK) {
            memcpy(x + Q, start, sizeof start);
            robot->now.current = false;
            return status;
        }
        for (int i = 0; i < STATES; i++) {
            double slope = x[DQ + i];
            sum[i] += weight[stage]*slope;
            x[Q + i] = start[i] + (stage < 3 ? h*ahead[stage]*slope : h/6.0*sum[i]);
        }
        robot->now.current = false;
    }
    return fmi3OK;
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    return fmi3OK; /* errors are always told, and nothing else is */
}

static fmi3Instance instantiated(fmi3String token, fmi3InstanceEnvironment environment,
                                 fmi3LogMessageCallback log)
{
    robot_instance *robot = calloc(1, sizeof *robot);
    if (robot == NULL) {
        return NULL;
    }
    robot->environment = environment;
    robot->log = log;
    if (token == NULL || strcmp(token, FMU_TOKEN) != 0) {
        told(robot, fmi3Error, "the instantiation token is not " FMU_TOKEN ": modelDescription.xml "
                               "is of another FMU than the binary; export it again");
        free(robot);
        return NULL;
    }
    started(&robot->now);
    return robot;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible,
                                          fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage)
{
    return instantiated(instantiationToken, instanceEnvironment, logMessage);
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
    fmi3Boolean earlyReturnAllowed, const fmi3ValueReference requiredIntermediateVariables[],
    size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback intermediateUpdate)
{
    return instantiated(instantiationToken, instanceEnvironment, logMessage);
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
    fmi3LockPreemptionCallback lockPreemption, fmi3UnlockPreemptionCallback unlockPreemption)
{
    return NULL; /* modelDescription.xml does not offer it */
}

void fmi3FreeInstance(fmi3Instance instance)
{
    free(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    ((robot_instance *)instance)->now.value[TIME] = startTime;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    ((robot_instance *)instance)->now.running = true;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    started(&((robot_instance *)instance)->now);
    return fmi3OK;
}

/* Changes of mode that change nothing here. */
#define MODE(name) \
    fmi3Status name(fmi3Instance instance) \
    { \
        return fmi3OK; \
    }
MODE(fmi3EnterEventMode)
MODE(fmi3Terminate)
MODE(fmi3EnterContinuousTimeMode)
MODE(fmi3EnterStepMode)
MODE(fmi3EnterConfigurationMode)
MODE(fmi3ExitConfigurationMode)
MODE(fmi3EvaluateDiscreteStates)

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, fmi3Float64 values[], size_t nValues)
{
    robot_instance *robot = instance;
    fmi3Status status = fmi3OK;
    if (nValues != nValueReferences) {
        return told(robot, fmi3Error, "every variable is one number");
    }
    for (size_t i = 0; i < nValues; i++) {
        const fmi3ValueReference at = valueReferences[i];
        if (at >= VALUES) {
            return told(robot, fmi3Error, "no such value reference");
        }
        if (at >= DQ && at < TAU) {
            status = derived(robot);
        }
        if (status != fmi3OK) {
            return status;
        }
        values[i] = robot->now.value[at];
    }
    return fmi3OK;
}

static const char *refused(const robot_state *now, fmi3ValueReference at, double value)
{
    if (at >= VALUES) {
        return "no such value reference";
    }
    if (at == TIME || (at >= DQ && at < TAU)) {
        return "time and derivatives cannot be set";
    }
    if (now->running && at >= Q && at < DQ) {
        return "positions and speeds can be set before the initialization ends only";
    }
    if (!isfinite(value)) {
        return "a value that is set is not finite";
    }
    if (at == STEP && !(value > 0.0)) {
        return "step must be positive";
    }
    if (at >= WIDTH && !(value > 0.0)) {
        return "widths of the Coulomb friction must be positive";
    }
    return NULL;
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                          size_t nValueReferences, const fmi3Float64 values[], size_t nValues)
{
    robot_instance *robot = instance;
    if (nValues != nValueReferences) {
        return told(robot, fmi3Error, "every variable is one number");
    }
    for (size_t i = 0; i < nValues; i++) {
        const char *why = refused(&robot->now, valueReferences[i], values[i]);
        if (why != NULL) {
            return told(robot, fmi3Error, why);
        }
        robot->now.value[valueReferences[i]] = values[i];
        robot->now.current = false;
    }
    return fmi3OK;
}

static fmi3Status absent(fmi3Instance instance, size_t asked)
{
    return asked == 0 ? fmi3OK : told(instance, fmi3Error, "there is nothing of this kind here");
}

/* Variables of other types: there are none. */
#define OTHER_TYPE(type) \
    fmi3Status fmi3Get##type(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, fmi3##type values[], size_t nValues) \
    { \
        return absent(instance, nValueReferences); \
    } \
    fmi3Status fmi3Set##type(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, const fmi3##type values[], size_t nValues) \
    { \
        return absent(instance, nValueReferences); \
    }
OTHER_TYPE(Float32)
OTHER_TYPE(Int8)
OTHER_TYPE(UInt8)
OTHER_TYPE(Int16)
OTHER_TYPE(UInt16)
OTHER_TYPE(Int32)
OTHER_TYPE(UInt32)
OTHER_TYPE(Int64)
OTHER_TYPE(UInt64)
OTHER_TYPE(Boolean)
OTHER_TYPE(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, size_t valueSizes[], fmi3Binary values[],
                         size_t nValues)
{
    return absent(instance, nValueReferences);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                         size_t nValueReferences, const size_t valueSizes[],
                         const fmi3Binary values[], size_t nValues)
{
    return absent(instance, nValueReferences);
}

/* Functions of clocks. */
#define CLOCKS(name, ...) \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                    size_t nValueReferences, __VA_ARGS__) \
    { \
        return absent(instance, nValueReferences); \
    }
CLOCKS(fmi3GetClock, fmi3Clock values[])
CLOCKS(fmi3SetClock, const fmi3Clock values[])
CLOCKS(fmi3GetIntervalDecimal, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
CLOCKS(fmi3GetIntervalFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
       fmi3IntervalQualifier qualifiers[])
CLOCKS(fmi3GetShiftDecimal, fmi3Float64 shifts[])
CLOCKS(fmi3GetShiftFraction, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
CLOCKS(fmi3SetIntervalDecimal, const fmi3Float64 intervals[])
CLOCKS(fmi3SetIntervalFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
CLOCKS(fmi3SetShiftDecimal, const fmi3Float64 shifts[])
CLOCKS(fmi3SetShiftFraction, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
CLOCKS(fmi3GetOutputDerivatives, const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues)

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime)
{
    return absent(instance, 1);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance,
                                               fmi3ValueReference valueReference,
                                               size_t *nDependencies)
{
    return absent(instance, 1);
}

fmi3Status fmi3GetVariableDependencies(
    fmi3Instance instance, fmi3ValueReference dependent, size_t elementIndicesOfDependent[],
    fmi3ValueReference independents[], size_t elementIndicesOfIndependents[],
    fmi3DependencyKind dependencyKinds[], size_t nDependencies)
{
    return absent(instance, 1);
}

#define DERIVATIVE(name) \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns, \
                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[], \
                    size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity) \
    { \
        return absent(instance, 1); \
    }
DERIVATIVE(fmi3GetDirectionalDerivative)
DERIVATIVE(fmi3GetAdjointDerivative)

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    robot_instance *robot = instance;
    robot_state *kept = *FMUState != NULL ? *FMUState : malloc(sizeof *kept);
    if (kept == NULL) {
        return told(robot, fmi3Error, "no memory for a copy of the state");
    }
    *kept = robot->now;
    *FMUState = kept;
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState)
{
    ((robot_instance *)instance)->now = *(robot_state *)FMUState;
    return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    if (FMUState != NULL) {
        free(*FMUState);
        *FMUState = NULL;
    }
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size)
{
    *size = sizeof(robot_state);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState,
                                 fmi3Byte serializedState[], size_t size)
{
    if (size < sizeof(robot_state)) {
        return told(instance, fmi3Error, "the buffer is too short for the state");
    }
    memcpy(serializedState, FMUState, sizeof(robot_state));
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[],
                                   size_t size, fmi3FMUState *FMUState)
{
    if (size != sizeof(robot_state)) {
        return told(instance, fmi3Error, "the buffer is no state of this robot");
    }
    fmi3Status status = fmi3GetFMUState(instance, FMUState);
    if (status == fmi3OK) {
        memcpy(*FMUState, serializedState, sizeof(robot_state));
    }
    return status;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined, fmi3Float64 *nextEventTime)
{
    *discreteStatesNeedUpdate = fmi3False;
    *terminateSimulation = fmi3False;
    *nominalsOfContinuousStatesChanged = fmi3False;
    *valuesOfContinuousStatesChanged = fmi3False;
    *nextEventTimeDefined = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance,
                                       fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode,
                                       fmi3Boolean *terminateSimulation)
{
    *enterEventMode = fmi3False;
    *terminateSimulation = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    ((robot_instance *)instance)->now.value[TIME] = time;
    return fmi3OK;
}

static fmi3Status counted(const robot_instance *robot, size_t count)
{
    return count == STATES ? fmi3OK : told(robot, fmi3Error, "another number of states");
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates)
{
    robot_instance *robot = instance;
    if (counted(robot, nContinuousStates) != fmi3OK) {
        return fmi3Error;
    }
    memcpy(robot->now.value + Q, continuousStates, STATES*sizeof *continuousStates);
    robot->now.current = false;
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[],
                                   size_t nContinuousStates)
{
    const robot_instance *robot = instance;
    if (counted(robot, nContinuousStates) != fmi3OK) {
        return fmi3Error;
    }
    memcpy(continuousStates, robot->now.value + Q, STATES*sizeof *continuousStates);
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates)
{
    robot_instance *robot = instance;
    if (counted(robot, nContinuousStates) != fmi3OK) {
        return fmi3Error;
    }
    fmi3Status status = derived(robot);
    if (status == fmi3OK) {
        memcpy(derivatives, robot->now.value + DQ, STATES*sizeof *derivatives);
    }
    return status;
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                             size_t nContinuousStates)
{
    if (counted(instance, nContinuousStates) != fmi3OK) {
        return fmi3Error;
    }
    for (int i = 0; i < STATES; i++) {
        nominals[i] = 1.0;
    }
    return fmi3OK;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[],
                                  size_t nEventIndicators)
{
    return absent(instance, nEventIndicators);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators)
{
    *nEventIndicators = 0;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates)
{
    *nContinuousStates = STATES;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                      fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                      fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
                      fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime)
{
    robot_instance *robot = instance;
    double *time = robot->now.value + TIME, size = communicationStepSize;
    *eventHandlingNeeded = fmi3False;
    *terminateSimulation = fmi3False;
    *earlyReturn = fmi3False;
    *lastSuccessfulTime = currentCommunicationPoint;
    if (!(size >= 0.0) || !isfinite(size)) {
        return told(robot, fmi3Error, "a communication step is a number of seconds from 0 on");
    }
    const double wanted = ceil(size/robot->now.value[STEP]*(1.0 - 1e-9));
    const double count = wanted > 1.0 ? wanted : 1.0, h = size/count;
    *time = currentCommunicationPoint;
    for (double k = 1.0; k <= count && size > 0.0; k += 1.0) {
        fmi3Status status = stepped(robot, h);
        if (status != fmi3OK) {
            return status;
        }
        *time = currentCommunicationPoint + (k < count ? k*h : size);
        *lastSuccessfulTime = *time;
    }
    return fmi3OK;
}
