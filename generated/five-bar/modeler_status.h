/* What functions that can fail return; the same for robots in double and in single precision. */
#ifndef MODELER_STATUS_H
#define MODELER_STATUS_H

/* Outputs are NaN, or as they were where a function says so, unless it is MODELER_DONE. */
enum modeler_status {
    MODELER_DONE = 0,
    MODELER_CLOSED = 0,     /* the same of closing loops */
    MODELER_OPEN = 1,       /* the loops cannot be closed on the way to these values */
    MODELER_SINGULAR = 2,   /* singular posture, or an inertia that is not positive */
    MODELER_NOT_FINITE = 3, /* an input is not finite, or an output would not be */
    MODELER_UNFINISHED = 4, /* the turns that are allowed did not do */
    MODELER_FOREIGN = 5     /* a parameter set of another robot, or changed since it was sealed */
};

/* The first failure of several calls: status = modeler_first(status, next_call(...)). */
static inline int modeler_first(int status, int more)
{
    return status != MODELER_DONE ? status : more;
}

#endif
