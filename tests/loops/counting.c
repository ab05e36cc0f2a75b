/* Counts how often the loops of an emitted robot are evaluated, and shows its state.
 * HEADER is that of the robot, PREFIX begins its names; the linker wraps what is counted. */
#include <stddef.h>
#include HEADER

#define PASTED(before, prefix, after) before##prefix##after
#define EXPANDED(before, prefix, after) PASTED(before, prefix, after)
#define NAME(before, after) EXPANDED(before, PREFIX, after)

size_t state_size(void);
double *last_posture(struct NAME(, _state) *state);
extern int evaluations;
int evaluations;

size_t state_size(void)
{
    return sizeof(struct NAME(, _state));
}

double *last_posture(struct NAME(, _state) *state)
{
    return state->at.u;
}

void NAME(__real_, _tree_closure)(const double *u, double *values);
void NAME(__wrap_, _tree_closure)(const double *u, double *values);
void NAME(__wrap_, _tree_closure)(const double *u, double *values)
{
    evaluations++;
    NAME(__real_, _tree_closure)(u, values);
}

void NAME(__real_, _tree_residual)(const double *u, double *f);
void NAME(__wrap_, _tree_residual)(const double *u, double *f);
void NAME(__wrap_, _tree_residual)(const double *u, double *f)
{
    evaluations++;
    NAME(__real_, _tree_residual)(u, f);
}
