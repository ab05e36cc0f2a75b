/* The links of an arm: inertia matrix, velocity and gravity torques, world frame. */
#pragma once
#include <stddef.h>
#include <stdint.h>

#include "plant.h"

typedef double Vector[3];
typedef double Matrix[9];

typedef struct {
    double inertia[MAX_JOINTS][MAX_JOINTS];
    double bias[MAX_JOINTS];    /* torque without acceleration */
    double gravity[MAX_JOINTS]; /* torque that holds the arm at rest */
    double tilting[MAX_JOINTS]; /* moment across the axis without acceleration */
    Vector axis[MAX_JOINTS], origin[MAX_JOINTS];
    Matrix rotation[MAX_JOINTS];
} Dynamics;

void links_dynamics(const Plant *plant, const double *q, const double *v, Dynamics *found);
void solve(int n, double matrix[MAX_JOINTS][MAX_JOINTS], double *vector);
void cross(const double *a, const double *b, double *result);
double dot(const double *a, const double *b);
void rotate(const double *matrix, const double *vector, double *result);
