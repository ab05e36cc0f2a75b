/* Newton and Euler about the centres of mass, in the world frame. */
#include "rigid_body.h"

#include <math.h>
#include <string.h>

void cross(const double *a, const double *b, double *result)
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void rotate(const double *matrix, const double *vector, double *result)
{
    for (int i = 0; i < 3; i++) result[i] = dot(matrix + 3 * i, vector);
}

static void product(const double *a, const double *b, double *result)
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            result[3 * i + k] = a[3 * i] * b[k] + a[3 * i + 1] * b[3 + k] + a[3 * i + 2] * b[6 + k];
}

/* R I R' */
static void turned(const double *rotation, const double *tensor, double *result)
{
    Matrix half;
    product(rotation, tensor, half);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) result[3 * i + k] = dot(half + 3 * i, rotation + 3 * k);
}

/* Motion of a frame, and of what moves with it. */
typedef struct {
    Matrix rotation;
    Vector place, spin, spin_change, acceleration;
} Frame;

/* w x (w x x) + w' x x */
static void swing(const Frame *frame, const double *arm, double *result)
{
    Vector speed, inward, sideways;
    cross(frame->spin, arm, speed);
    cross(frame->spin, speed, inward);
    cross(frame->spin_change, arm, sideways);
    for (int i = 0; i < 3; i++) result[i] = inward[i] + sideways[i];
}

static void next_frame(const Plant *plant, int j, double q, double v, Frame *frame)
{
    double ca = cos(plant->alpha[j]), sa = sin(plant->alpha[j]);
    double ct = cos(q + plant->theta0[j]), st = sin(q + plant->theta0[j]);
    const Matrix local = {ct, -st, 0, ca * st, ca * ct, -sa, sa * st, sa * ct, ca};
    const Vector shift = {plant->d[j], -plant->r[j] * sa, plant->r[j] * ca};
    Vector arm, change, turn;
    rotate(frame->rotation, shift, arm);
    swing(frame, arm, change);
    for (int i = 0; i < 3; i++) {
        frame->place[i] += arm[i];
        frame->acceleration[i] += change[i];
    }
    Matrix rotation;
    product(frame->rotation, local, rotation);
    memcpy(frame->rotation, rotation, sizeof rotation);
    const Vector axis = {rotation[2], rotation[5], rotation[8]};
    cross(frame->spin, axis, turn);
    for (int i = 0; i < 3; i++) {
        frame->spin_change[i] += v * turn[i];
        frame->spin[i] += v * axis[i];
    }
}

/* What a link asks for: its force and moment about its centre. */
typedef struct {
    Vector centre, force, moment;
    Matrix inertia;
} Link;

static void link_forces(const Plant *plant, int j, const Frame *frame, Link *link)
{
    Vector arm, change, momentum, spin_up, gyroscopic;
    rotate(frame->rotation, plant->centre[j], arm);
    swing(frame, arm, change);
    turned(frame->rotation, plant->inertia[j], link->inertia);
    rotate(link->inertia, frame->spin, momentum);
    rotate(link->inertia, frame->spin_change, spin_up);
    cross(frame->spin, momentum, gyroscopic);
    for (int i = 0; i < 3; i++) {
        link->centre[i] = frame->place[i] + arm[i];
        link->force[i] = plant->mass[j] * (frame->acceleration[i] + change[i]);
        link->moment[i] = spin_up[i] + gyroscopic[i];
    }
}

/* All links from one on, as one body: force and moment, mass, and inertia about the origin. */
typedef struct {
    Vector force, moment, mass_moment;
    double mass;
    Matrix inertia;
} Body;

static void take_on(Body *body, const Link *link, double mass)
{
    Vector moment;
    cross(link->centre, link->force, moment);
    for (int i = 0; i < 3; i++) {
        body->force[i] += link->force[i];
        body->moment[i] += link->moment[i] + moment[i];
        body->mass_moment[i] += mass * link->centre[i];
    }
    body->mass += mass;
    double square = dot(link->centre, link->centre);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            body->inertia[3 * i + k] +=
                link->inertia[3 * i + k] +
                mass * ((i == k ? square : 0) - link->centre[i] * link->centre[k]);
}

/* Row j of what is asked for: the body beyond joint j, turned by its axis alone. */
static void joint_row(const Plant *plant, const Body *body, int j, Dynamics *found)
{
    const double *axis = found->axis[j], *origin = found->origin[j];
    Vector about, tilt, arm, weight, force, lever, moment, shifted;
    cross(origin, body->force, about);
    for (int i = 0; i < 3; i++) {
        about[i] = body->moment[i] - about[i];
        arm[i] = body->mass_moment[i] - body->mass * origin[i];
    }
    found->bias[j] = dot(axis, about);
    cross(axis, about, tilt);
    found->tilting[j] = sqrt(dot(tilt, tilt));
    cross(arm, plant->gravity, weight);
    found->gravity[j] = -dot(axis, weight);
    cross(axis, arm, force);
    cross(axis, origin, lever);
    rotate(body->inertia, axis, moment);
    cross(body->mass_moment, lever, shifted);
    for (int k = 0; k <= j; k++) {
        Vector at, total;
        cross(found->origin[k], force, at);
        for (int i = 0; i < 3; i++) total[i] = moment[i] - shifted[i] - at[i];
        found->inertia[k][j] = found->inertia[j][k] = dot(found->axis[k], total);
    }
}

void links_dynamics(const Plant *plant, const double *q, const double *v, Dynamics *found)
{
    Link links[MAX_JOINTS];
    Frame frame = {.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    for (int i = 0; i < 3; i++) frame.acceleration[i] = -plant->gravity[i];
    for (int j = 0; j < plant->joints; j++) {
        next_frame(plant, j, q[j], v[j], &frame);
        memcpy(found->rotation[j], frame.rotation, sizeof frame.rotation);
        memcpy(found->origin[j], frame.place, sizeof frame.place);
        for (int i = 0; i < 3; i++) found->axis[j][i] = frame.rotation[3 * i + 2];
        link_forces(plant, j, &frame, &links[j]);
    }
    Body body = {.mass = 0};
    for (int j = plant->joints - 1; j >= 0; j--) {
        take_on(&body, &links[j], plant->mass[j]);
        joint_row(plant, &body, j, found);
    }
}

/* Cholesky; the vector becomes the solution. */
void solve(int n, double matrix[MAX_JOINTS][MAX_JOINTS], double *vector)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double rest = matrix[i][j];
            for (int k = 0; k < j; k++) rest -= matrix[i][k] * matrix[j][k];
            matrix[i][j] = i == j ? sqrt(rest) : rest / matrix[j][j];
        }
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++) vector[i] -= matrix[i][k] * vector[k];
        vector[i] /= matrix[i][i];
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++) vector[i] -= matrix[k][i] * vector[k];
        vector[i] /= matrix[i][i];
    }
}

void inverse_dynamics(const Plant *plant, int samples, const double *q, const double *v,
                      const double *a, double *torque, double *diagonal, double *gravity)
{
    int n = plant->joints;
    Dynamics found;
    for (int row = 0; row < samples * n; row += n) {
        links_dynamics(plant, q + row, v + row, &found);
        for (int j = 0; j < n; j++) {
            torque[row + j] = found.bias[j];
            for (int k = 0; k < n; k++) torque[row + j] += found.inertia[j][k] * a[row + k];
            diagonal[row + j] = found.inertia[j][j];
            gravity[row + j] = found.gravity[j];
        }
    }
}
