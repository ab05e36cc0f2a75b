/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * Functions of evra_tile.h.
 * This file includes itself once for every instruction set.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef MODELER_VERSION

#include "evra_tile.h"

#include <string.h>

#include "evra_tree.h"

/* Lengths of evra_loops. */
#define GIVEN 8
#define UNKNOWNS 26
#define SOLVED 18
#define FACTORS 107
#define COUPLINGS 144
#define JACOBIAN 132
#define JACOBIAN_AT 18
#define TURNS_AT 150
#define LENGTH 180

/* Geometry; see evra.c. */
#ifndef EVRA_GEO_g
#define EVRA_GEO_g 9.81
#endif
#ifndef EVRA_GEO_RB
#define EVRA_GEO_RB 0.6
#endif
#ifndef EVRA_GEO_RP
#define EVRA_GEO_RP 0.35
#endif
#ifndef EVRA_GEO_beta1
#define EVRA_GEO_beta1 0.1745
#endif
#ifndef EVRA_GEO_beta2
#define EVRA_GEO_beta2 1.9199
#endif
#ifndef EVRA_GEO_beta3
#define EVRA_GEO_beta3 2.2689
#endif
#ifndef EVRA_GEO_beta4
#define EVRA_GEO_beta4 4.0143
#endif
#ifndef EVRA_GEO_beta5
#define EVRA_GEO_beta5 4.3633
#endif
#ifndef EVRA_GEO_beta6
#define EVRA_GEO_beta6 6.1087
#endif
#ifndef EVRA_GEO_phi1
#define EVRA_GEO_phi1 0.8727
#endif
#ifndef EVRA_GEO_phi2
#define EVRA_GEO_phi2 1.2217
#endif
#ifndef EVRA_GEO_phi3
#define EVRA_GEO_phi3 2.9671
#endif
#ifndef EVRA_GEO_phi4
#define EVRA_GEO_phi4 3.3161
#endif
#ifndef EVRA_GEO_phi5
#define EVRA_GEO_phi5 5.0615
#endif
#ifndef EVRA_GEO_phi6
#define EVRA_GEO_phi6 5.4105
#endif

static const double evra_geo_g = EVRA_GEO_g;
static const double evra_geo_RB = EVRA_GEO_RB;
static const double evra_geo_RP = EVRA_GEO_RP;
static const double evra_geo_beta1 = EVRA_GEO_beta1;
static const double evra_geo_beta2 = EVRA_GEO_beta2;
static const double evra_geo_beta3 = EVRA_GEO_beta3;
static const double evra_geo_beta4 = EVRA_GEO_beta4;
static const double evra_geo_beta5 = EVRA_GEO_beta5;
static const double evra_geo_beta6 = EVRA_GEO_beta6;
static const double evra_geo_phi1 = EVRA_GEO_phi1;
static const double evra_geo_phi2 = EVRA_GEO_phi2;
static const double evra_geo_phi3 = EVRA_GEO_phi3;
static const double evra_geo_phi4 = EVRA_GEO_phi4;
static const double evra_geo_phi5 = EVRA_GEO_phi5;
static const double evra_geo_phi6 = EVRA_GEO_phi6;

static const int row[] = {
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
    1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2,
    2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3,
    3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4,
    4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4,
    4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 5, 5,
    5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5,
    5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5,
    5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6,
    6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6,
    6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6,
    6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7,
    7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7,
    7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7,
    7, 7, 7
};

static const int column[] = {
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25,
    26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49,
    50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73,
    74, 75, 76, 77, 78, 79, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,
    11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34,
    35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58,
    59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82,
    83, 84, 85, 86, 87, 88, 89, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 14, 15, 16, 17, 18, 19, 20,
    21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44,
    45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68,
    69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 1, 2, 3,
    4, 5, 6, 7, 8, 9, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30,
    31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54,
    55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78,
    79, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 14, 15, 16,
    17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40,
    41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64,
    65, 66, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83, 84, 85, 86, 87, 88,
    89, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
    27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50,
    51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73, 74,
    75, 76, 77, 78, 79, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12,
    13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36,
    37, 38, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60,
    61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83, 84,
    85, 86, 87, 88, 89, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22,
    23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 44, 45, 46,
    47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70,
    71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89
};

#define ENTRIES 707

#define MODELER_BODY "evra_tile.c"
#include "modeler_versions.h"

#ifdef MODELER_APART /* who loads this library has them in another one */
#define SINGLES NULL
#else
static const struct evra_single singles = {&evra_loops, evra_posed, evra_tree_next, modeler_eliminated};
#define SINGLES &singles
#endif

#define TILED(version) \
    {8, 90, 0, ENTRIES, row, column, NULL, closing_##version, sizeof(closing_state), SINGLES}

static const modeler_tiled tiled[] = {MODELER_EACH_VERSION(TILED)};

const modeler_tiled *evra_tiled(void)
{
    return &tiled[MODELER_BEST_VERSION];
}

const char *evra_tile_signature(void)
{
    return "e1952a67b957d79a";
}

#else /* for one instruction set */

#include "modeler_lanes.h"

MODELER_TARGET static void MODELER_VERSION(closure)(
const modeler_lanes *q, modeler_lanes *MODELER_RESTRICT values)
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double p_B1_x = x_B1_x*evra_geo_RB;
    const double p_B1_y = x_B1_y*evra_geo_RB;
    const double p41_x = cos(evra_geo_phi1)*evra_geo_RP;
    const double p41_y = sin(evra_geo_phi1)*evra_geo_RP;
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double p_B2_x = evra_geo_RB*x_B2_x;
    const double p_B2_y = evra_geo_RB*x_B2_y;
    const double p42_x = evra_geo_RP*cos(evra_geo_phi2);
    const double p42_y = evra_geo_RP*sin(evra_geo_phi2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double p_B3_x = evra_geo_RB*x_B3_x;
    const double p_B3_y = evra_geo_RB*x_B3_y;
    const double p43_x = evra_geo_RP*cos(evra_geo_phi3);
    const double p43_y = evra_geo_RP*sin(evra_geo_phi3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double p_B4_x = evra_geo_RB*x_B4_x;
    const double p_B4_y = evra_geo_RB*x_B4_y;
    const double p44_x = evra_geo_RP*cos(evra_geo_phi4);
    const double p44_y = evra_geo_RP*sin(evra_geo_phi4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double p_B5_x = evra_geo_RB*x_B5_x;
    const double p_B5_y = evra_geo_RB*x_B5_y;
    const double p45_x = evra_geo_RP*cos(evra_geo_phi5);
    const double p45_y = evra_geo_RP*sin(evra_geo_phi5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);
    const double p_B6_x = evra_geo_RB*x_B6_x;
    const double p_B6_y = evra_geo_RB*x_B6_y;
    const double p46_x = evra_geo_RP*cos(evra_geo_phi6);
    const double p46_y = evra_geo_RP*sin(evra_geo_phi6);
    modeler_lanes s3, c3;
    modeler_lanes_sincos(q[3], &s3, &c3);
    modeler_lanes s4, c4;
    modeler_lanes_sincos(q[4], &s4, &c4);
    modeler_lanes s5, c5;
    modeler_lanes_sincos(q[5], &s5, &c5);
    modeler_lanes s8, c8;
    modeler_lanes_sincos(q[8], &s8, &c8);
    modeler_lanes s9, c9;
    modeler_lanes_sincos(q[9], &s9, &c9);
    modeler_lanes s11, c11;
    modeler_lanes_sincos(q[11], &s11, &c11);
    modeler_lanes s12, c12;
    modeler_lanes_sincos(q[12], &s12, &c12);
    modeler_lanes s14, c14;
    modeler_lanes_sincos(q[14], &s14, &c14);
    modeler_lanes s15, c15;
    modeler_lanes_sincos(q[15], &s15, &c15);
    modeler_lanes s17, c17;
    modeler_lanes_sincos(q[17], &s17, &c17);
    modeler_lanes s18, c18;
    modeler_lanes_sincos(q[18], &s18, &c18);
    modeler_lanes s20, c20;
    modeler_lanes_sincos(q[20], &s20, &c20);
    modeler_lanes s21, c21;
    modeler_lanes_sincos(q[21], &s21, &c21);
    modeler_lanes s23, c23;
    modeler_lanes_sincos(q[23], &s23, &c23);
    modeler_lanes s24, c24;
    modeler_lanes_sincos(q[24], &s24, &c24);
    const modeler_lanes minus_x11_x = x_B1_x*s8;
    const modeler_lanes y21_x = x_B1_y*s9 + c9*minus_x11_x;
    const modeler_lanes x_P_x = c4*c5;
    const modeler_lanes minus_y_P_x = c4*s5;
    values[0] = q[6] + p_B1_x - q[10]*y21_x + (p41_y*minus_y_P_x - (q[0] + p41_x*x_P_x));
    const modeler_lanes minus_x11_y = x_B1_y*s8;
    const modeler_lanes minus_y21_y = x_B1_x*s9 - c9*minus_x11_y;
    const modeler_lanes y_Pb_y = s3*s4;
    const modeler_lanes x_P_y = c5*y_Pb_y + c3*s5;
    const modeler_lanes t9 = p41_x*x_P_y;
    const modeler_lanes y_P_y = c3*c5 - s5*y_Pb_y;
    const modeler_lanes t11 = p41_y*y_P_y;
    values[1] = q[7] + p_B1_y + q[10]*minus_y21_y - (q[1] + t9 + t11);
    const modeler_lanes y21_z = c8*c9;
    const modeler_lanes minus_y_Pb_z = c3*s4;
    const modeler_lanes minus_x_P_z = c5*minus_y_Pb_z - s3*s5;
    const modeler_lanes t15 = p41_x*minus_x_P_z;
    const modeler_lanes y_P_z = s3*c5 + s5*minus_y_Pb_z;
    const modeler_lanes t17 = p41_y*y_P_z;
    values[2] = -(q[2] - t15 + t17 + q[10]*y21_z);
    const modeler_lanes minus_x12_x = x_B2_x*s11;
    const modeler_lanes y22_x = x_B2_y*s12 + c12*minus_x12_x;
    values[3] = q[6] + p_B2_x - q[13]*y22_x + (p42_y*minus_y_P_x - (q[0] + p42_x*x_P_x));
    const modeler_lanes minus_x12_y = x_B2_y*s11;
    const modeler_lanes minus_y22_y = x_B2_x*s12 - c12*minus_x12_y;
    const modeler_lanes t22 = p42_x*x_P_y;
    const modeler_lanes t23 = p42_y*y_P_y;
    values[4] = q[7] + p_B2_y + q[13]*minus_y22_y - (q[1] + t22 + t23);
    const modeler_lanes y22_z = c11*c12;
    const modeler_lanes t25 = p42_x*minus_x_P_z;
    const modeler_lanes t26 = p42_y*y_P_z;
    values[5] = -(q[2] - t25 + t26 + q[13]*y22_z);
    const modeler_lanes minus_x13_x = x_B3_x*s14;
    const modeler_lanes y23_x = x_B3_y*s15 + c15*minus_x13_x;
    values[6] = q[6] + p_B3_x - q[16]*y23_x + (p43_y*minus_y_P_x - (q[0] + p43_x*x_P_x));
    const modeler_lanes minus_x13_y = x_B3_y*s14;
    const modeler_lanes minus_y23_y = x_B3_x*s15 - c15*minus_x13_y;
    const modeler_lanes t31 = p43_x*x_P_y;
    const modeler_lanes t32 = p43_y*y_P_y;
    values[7] = q[7] + p_B3_y + q[16]*minus_y23_y - (q[1] + t31 + t32);
    const modeler_lanes y23_z = c14*c15;
    const modeler_lanes t34 = p43_x*minus_x_P_z;
    const modeler_lanes t35 = p43_y*y_P_z;
    values[8] = -(q[2] - t34 + t35 + q[16]*y23_z);
    const modeler_lanes minus_x14_x = x_B4_x*s17;
    const modeler_lanes y24_x = x_B4_y*s18 + c18*minus_x14_x;
    values[9] = q[6] + p_B4_x - q[19]*y24_x + (p44_y*minus_y_P_x - (q[0] + p44_x*x_P_x));
    const modeler_lanes minus_x14_y = x_B4_y*s17;
    const modeler_lanes minus_y24_y = x_B4_x*s18 - c18*minus_x14_y;
    const modeler_lanes t40 = p44_x*x_P_y;
    const modeler_lanes t41 = p44_y*y_P_y;
    values[10] = q[7] + p_B4_y + q[19]*minus_y24_y - (q[1] + t40 + t41);
    const modeler_lanes y24_z = c17*c18;
    const modeler_lanes t43 = p44_x*minus_x_P_z;
    const modeler_lanes t44 = p44_y*y_P_z;
    values[11] = -(q[2] - t43 + t44 + q[19]*y24_z);
    const modeler_lanes minus_x15_x = x_B5_x*s20;
    const modeler_lanes y25_x = x_B5_y*s21 + c21*minus_x15_x;
    values[12] = q[6] + p_B5_x - q[22]*y25_x + (p45_y*minus_y_P_x - (q[0] + p45_x*x_P_x));
    const modeler_lanes minus_x15_y = x_B5_y*s20;
    const modeler_lanes minus_y25_y = x_B5_x*s21 - c21*minus_x15_y;
    const modeler_lanes t49 = p45_x*x_P_y;
    const modeler_lanes t50 = p45_y*y_P_y;
    values[13] = q[7] + p_B5_y + q[22]*minus_y25_y - (q[1] + t49 + t50);
    const modeler_lanes y25_z = c20*c21;
    const modeler_lanes t52 = p45_x*minus_x_P_z;
    const modeler_lanes t53 = p45_y*y_P_z;
    values[14] = -(q[2] - t52 + t53 + q[22]*y25_z);
    const modeler_lanes minus_x16_x = x_B6_x*s23;
    const modeler_lanes y26_x = x_B6_y*s24 + c24*minus_x16_x;
    values[15] = q[6] + p_B6_x - q[25]*y26_x + (p46_y*minus_y_P_x - (q[0] + p46_x*x_P_x));
    const modeler_lanes minus_x16_y = x_B6_y*s23;
    const modeler_lanes minus_y26_y = x_B6_x*s24 - c24*minus_x16_y;
    const modeler_lanes t58 = p46_x*x_P_y;
    const modeler_lanes t59 = p46_y*y_P_y;
    values[16] = q[7] + p_B6_y + q[25]*minus_y26_y - (q[1] + t58 + t59);
    const modeler_lanes y26_z = c23*c24;
    const modeler_lanes t61 = p46_x*minus_x_P_z;
    const modeler_lanes t62 = p46_y*y_P_z;
    values[17] = -(q[2] - t61 + t62 + q[25]*y26_z);
    values[18] = modeler_lanes_spread(-1.0);
    const modeler_lanes minus_x_Pd_q4x = s4*c5;
    const modeler_lanes y_Pd_q4x = s4*s5;
    values[19] = p41_x*minus_x_Pd_q4x - p41_y*y_Pd_q4x;
    values[20] = p41_x*minus_y_P_x + p41_y*x_P_x;
    values[21] = modeler_lanes_spread(1.0);
    values[22] = -x_B1_x*c8*c9*q[10];
    values[23] = q[10]*(s9*minus_x11_x - x_B1_y*c9);
    values[24] = -y21_x;
    values[25] = modeler_lanes_spread(-1.0);
    values[26] = t17 - t15;
    const modeler_lanes minus_x_Pb_y = s3*c4;
    const modeler_lanes x_Pd_q4y = c5*minus_x_Pb_y;
    const modeler_lanes minus_y_Pd_q4y = s5*minus_x_Pb_y;
    values[27] = p41_y*minus_y_Pd_q4y - p41_x*x_Pd_q4y;
    values[28] = p41_y*x_P_y - p41_x*y_P_y;
    values[29] = modeler_lanes_spread(1.0);
    values[30] = -x_B1_y*c8*c9*q[10];
    values[31] = q[10]*(s9*minus_x11_y + x_B1_x*c9);
    values[32] = minus_y21_y;
    values[33] = modeler_lanes_spread(-1.0);
    values[34] = -(t9 + t11);
    const modeler_lanes x_Pb_z = c3*c4;
    const modeler_lanes minus_x_Pd_q4z = c5*x_Pb_z;
    const modeler_lanes y_Pd_q4z = s5*x_Pb_z;
    values[35] = p41_x*minus_x_Pd_q4z - p41_y*y_Pd_q4z;
    values[36] = -(p41_x*y_P_z + p41_y*minus_x_P_z);
    values[37] = s8*c9*q[10];
    values[38] = c8*s9*q[10];
    values[39] = -y21_z;
    values[40] = modeler_lanes_spread(-1.0);
    values[41] = p42_x*minus_x_Pd_q4x - p42_y*y_Pd_q4x;
    values[42] = p42_x*minus_y_P_x + p42_y*x_P_x;
    values[43] = modeler_lanes_spread(1.0);
    values[44] = -x_B2_x*c11*c12*q[13];
    values[45] = q[13]*(s12*minus_x12_x - x_B2_y*c12);
    values[46] = -y22_x;
    values[47] = modeler_lanes_spread(-1.0);
    values[48] = t26 - t25;
    values[49] = p42_y*minus_y_Pd_q4y - p42_x*x_Pd_q4y;
    values[50] = p42_y*x_P_y - p42_x*y_P_y;
    values[51] = modeler_lanes_spread(1.0);
    values[52] = -x_B2_y*c11*c12*q[13];
    values[53] = q[13]*(s12*minus_x12_y + x_B2_x*c12);
    values[54] = minus_y22_y;
    values[55] = modeler_lanes_spread(-1.0);
    values[56] = -(t22 + t23);
    values[57] = p42_x*minus_x_Pd_q4z - p42_y*y_Pd_q4z;
    values[58] = -(p42_x*y_P_z + p42_y*minus_x_P_z);
    values[59] = s11*c12*q[13];
    values[60] = c11*s12*q[13];
    values[61] = -y22_z;
    values[62] = modeler_lanes_spread(-1.0);
    values[63] = p43_x*minus_x_Pd_q4x - p43_y*y_Pd_q4x;
    values[64] = p43_x*minus_y_P_x + p43_y*x_P_x;
    values[65] = modeler_lanes_spread(1.0);
    values[66] = -x_B3_x*c14*c15*q[16];
    values[67] = q[16]*(s15*minus_x13_x - x_B3_y*c15);
    values[68] = -y23_x;
    values[69] = modeler_lanes_spread(-1.0);
    values[70] = t35 - t34;
    values[71] = p43_y*minus_y_Pd_q4y - p43_x*x_Pd_q4y;
    values[72] = p43_y*x_P_y - p43_x*y_P_y;
    values[73] = modeler_lanes_spread(1.0);
    values[74] = -x_B3_y*c14*c15*q[16];
    values[75] = q[16]*(s15*minus_x13_y + x_B3_x*c15);
    values[76] = minus_y23_y;
    values[77] = modeler_lanes_spread(-1.0);
    values[78] = -(t31 + t32);
    values[79] = p43_x*minus_x_Pd_q4z - p43_y*y_Pd_q4z;
    values[80] = -(p43_x*y_P_z + p43_y*minus_x_P_z);
    values[81] = s14*c15*q[16];
    values[82] = c14*s15*q[16];
    values[83] = -y23_z;
    values[84] = modeler_lanes_spread(-1.0);
    values[85] = p44_x*minus_x_Pd_q4x - p44_y*y_Pd_q4x;
    values[86] = p44_x*minus_y_P_x + p44_y*x_P_x;
    values[87] = modeler_lanes_spread(1.0);
    values[88] = -x_B4_x*c17*c18*q[19];
    values[89] = q[19]*(s18*minus_x14_x - x_B4_y*c18);
    values[90] = -y24_x;
    values[91] = modeler_lanes_spread(-1.0);
    values[92] = t44 - t43;
    values[93] = p44_y*minus_y_Pd_q4y - p44_x*x_Pd_q4y;
    values[94] = p44_y*x_P_y - p44_x*y_P_y;
    values[95] = modeler_lanes_spread(1.0);
    values[96] = -x_B4_y*c17*c18*q[19];
    values[97] = q[19]*(s18*minus_x14_y + x_B4_x*c18);
    values[98] = minus_y24_y;
    values[99] = modeler_lanes_spread(-1.0);
    values[100] = -(t40 + t41);
    values[101] = p44_x*minus_x_Pd_q4z - p44_y*y_Pd_q4z;
    values[102] = -(p44_x*y_P_z + p44_y*minus_x_P_z);
    values[103] = s17*c18*q[19];
    values[104] = c17*s18*q[19];
    values[105] = -y24_z;
    values[106] = modeler_lanes_spread(-1.0);
    values[107] = p45_x*minus_x_Pd_q4x - p45_y*y_Pd_q4x;
    values[108] = p45_x*minus_y_P_x + p45_y*x_P_x;
    values[109] = modeler_lanes_spread(1.0);
    values[110] = -x_B5_x*c20*c21*q[22];
    values[111] = q[22]*(s21*minus_x15_x - x_B5_y*c21);
    values[112] = -y25_x;
    values[113] = modeler_lanes_spread(-1.0);
    values[114] = t53 - t52;
    values[115] = p45_y*minus_y_Pd_q4y - p45_x*x_Pd_q4y;
    values[116] = p45_y*x_P_y - p45_x*y_P_y;
    values[117] = modeler_lanes_spread(1.0);
    values[118] = -x_B5_y*c20*c21*q[22];
    values[119] = q[22]*(s21*minus_x15_y + x_B5_x*c21);
    values[120] = minus_y25_y;
    values[121] = modeler_lanes_spread(-1.0);
    values[122] = -(t49 + t50);
    values[123] = p45_x*minus_x_Pd_q4z - p45_y*y_Pd_q4z;
    values[124] = -(p45_x*y_P_z + p45_y*minus_x_P_z);
    values[125] = s20*c21*q[22];
    values[126] = c20*s21*q[22];
    values[127] = -y25_z;
    values[128] = modeler_lanes_spread(-1.0);
    values[129] = p46_x*minus_x_Pd_q4x - p46_y*y_Pd_q4x;
    values[130] = p46_x*minus_y_P_x + p46_y*x_P_x;
    values[131] = modeler_lanes_spread(1.0);
    values[132] = -x_B6_x*c23*c24*q[25];
    values[133] = q[25]*(s24*minus_x16_x - x_B6_y*c24);
    values[134] = -y26_x;
    values[135] = modeler_lanes_spread(-1.0);
    values[136] = t62 - t61;
    values[137] = p46_y*minus_y_Pd_q4y - p46_x*x_Pd_q4y;
    values[138] = p46_y*x_P_y - p46_x*y_P_y;
    values[139] = modeler_lanes_spread(1.0);
    values[140] = -x_B6_y*c23*c24*q[25];
    values[141] = q[25]*(s24*minus_x16_y + x_B6_x*c24);
    values[142] = minus_y26_y;
    values[143] = modeler_lanes_spread(-1.0);
    values[144] = -(t58 + t59);
    values[145] = p46_x*minus_x_Pd_q4z - p46_y*y_Pd_q4z;
    values[146] = -(p46_x*y_P_z + p46_y*minus_x_P_z);
    values[147] = s23*c24*q[25];
    values[148] = c23*s24*q[25];
    values[149] = -y26_z;
    values[150] = c3;
    values[151] = s3;
    values[152] = c4;
    values[153] = s4;
    values[154] = c5;
    values[155] = s5;
    values[156] = c8;
    values[157] = s8;
    values[158] = c9;
    values[159] = s9;
    values[160] = c11;
    values[161] = s11;
    values[162] = c12;
    values[163] = s12;
    values[164] = c14;
    values[165] = s14;
    values[166] = c15;
    values[167] = s15;
    values[168] = c17;
    values[169] = s17;
    values[170] = c18;
    values[171] = s18;
    values[172] = c20;
    values[173] = s20;
    values[174] = c21;
    values[175] = s21;
    values[176] = c23;
    values[177] = s23;
    values[178] = c24;
    values[179] = s24;
}

MODELER_TARGET static void MODELER_VERSION(residual)(
const modeler_lanes *q, modeler_lanes *MODELER_RESTRICT f)
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double p_B1_x = x_B1_x*evra_geo_RB;
    const double p_B1_y = x_B1_y*evra_geo_RB;
    const double p41_x = cos(evra_geo_phi1)*evra_geo_RP;
    const double p41_y = sin(evra_geo_phi1)*evra_geo_RP;
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double p_B2_x = evra_geo_RB*x_B2_x;
    const double p_B2_y = evra_geo_RB*x_B2_y;
    const double p42_x = evra_geo_RP*cos(evra_geo_phi2);
    const double p42_y = evra_geo_RP*sin(evra_geo_phi2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double p_B3_x = evra_geo_RB*x_B3_x;
    const double p_B3_y = evra_geo_RB*x_B3_y;
    const double p43_x = evra_geo_RP*cos(evra_geo_phi3);
    const double p43_y = evra_geo_RP*sin(evra_geo_phi3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double p_B4_x = evra_geo_RB*x_B4_x;
    const double p_B4_y = evra_geo_RB*x_B4_y;
    const double p44_x = evra_geo_RP*cos(evra_geo_phi4);
    const double p44_y = evra_geo_RP*sin(evra_geo_phi4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double p_B5_x = evra_geo_RB*x_B5_x;
    const double p_B5_y = evra_geo_RB*x_B5_y;
    const double p45_x = evra_geo_RP*cos(evra_geo_phi5);
    const double p45_y = evra_geo_RP*sin(evra_geo_phi5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);
    const double p_B6_x = evra_geo_RB*x_B6_x;
    const double p_B6_y = evra_geo_RB*x_B6_y;
    const double p46_x = evra_geo_RP*cos(evra_geo_phi6);
    const double p46_y = evra_geo_RP*sin(evra_geo_phi6);
    modeler_lanes s3, c3;
    modeler_lanes_sincos(q[3], &s3, &c3);
    modeler_lanes s4, c4;
    modeler_lanes_sincos(q[4], &s4, &c4);
    modeler_lanes s5, c5;
    modeler_lanes_sincos(q[5], &s5, &c5);
    modeler_lanes s8, c8;
    modeler_lanes_sincos(q[8], &s8, &c8);
    modeler_lanes s9, c9;
    modeler_lanes_sincos(q[9], &s9, &c9);
    modeler_lanes s11, c11;
    modeler_lanes_sincos(q[11], &s11, &c11);
    modeler_lanes s12, c12;
    modeler_lanes_sincos(q[12], &s12, &c12);
    modeler_lanes s14, c14;
    modeler_lanes_sincos(q[14], &s14, &c14);
    modeler_lanes s15, c15;
    modeler_lanes_sincos(q[15], &s15, &c15);
    modeler_lanes s17, c17;
    modeler_lanes_sincos(q[17], &s17, &c17);
    modeler_lanes s18, c18;
    modeler_lanes_sincos(q[18], &s18, &c18);
    modeler_lanes s20, c20;
    modeler_lanes_sincos(q[20], &s20, &c20);
    modeler_lanes s21, c21;
    modeler_lanes_sincos(q[21], &s21, &c21);
    modeler_lanes s23, c23;
    modeler_lanes_sincos(q[23], &s23, &c23);
    modeler_lanes s24, c24;
    modeler_lanes_sincos(q[24], &s24, &c24);
    const modeler_lanes x_P_x = c4*c5;
    const modeler_lanes minus_y_P_x = c4*s5;
    f[0] = q[6] + p_B1_x - q[10]*(x_B1_y*s9 + x_B1_x*s8*c9) + (p41_y*minus_y_P_x - (q[0] +
    p41_x*x_P_x));
    const modeler_lanes y_Pb_y = s3*s4;
    const modeler_lanes x_P_y = c5*y_Pb_y + c3*s5;
    const modeler_lanes y_P_y = c3*c5 - s5*y_Pb_y;
    f[1] = q[7] + p_B1_y + q[10]*(x_B1_x*s9 - x_B1_y*s8*c9) - (q[1] + p41_x*x_P_y + p41_y*y_P_y);
    const modeler_lanes minus_y_Pb_z = c3*s4;
    const modeler_lanes minus_x_P_z = c5*minus_y_Pb_z - s3*s5;
    const modeler_lanes y_P_z = s3*c5 + s5*minus_y_Pb_z;
    f[2] = -(q[2] - p41_x*minus_x_P_z + p41_y*y_P_z + c8*c9*q[10]);
    f[3] = q[6] + p_B2_x - q[13]*(x_B2_y*s12 + x_B2_x*s11*c12) + (p42_y*minus_y_P_x - (q[0] +
    p42_x*x_P_x));
    f[4] = q[7] + p_B2_y + q[13]*(x_B2_x*s12 - x_B2_y*s11*c12) - (q[1] + p42_x*x_P_y + p42_y*y_P_y);
    f[5] = -(q[2] - p42_x*minus_x_P_z + p42_y*y_P_z + c11*c12*q[13]);
    f[6] = q[6] + p_B3_x - q[16]*(x_B3_y*s15 + x_B3_x*s14*c15) + (p43_y*minus_y_P_x - (q[0] +
    p43_x*x_P_x));
    f[7] = q[7] + p_B3_y + q[16]*(x_B3_x*s15 - x_B3_y*s14*c15) - (q[1] + p43_x*x_P_y + p43_y*y_P_y);
    f[8] = -(q[2] - p43_x*minus_x_P_z + p43_y*y_P_z + c14*c15*q[16]);
    f[9] = q[6] + p_B4_x - q[19]*(x_B4_y*s18 + x_B4_x*s17*c18) + (p44_y*minus_y_P_x - (q[0] +
    p44_x*x_P_x));
    f[10] = q[7] + p_B4_y + q[19]*(x_B4_x*s18 - x_B4_y*s17*c18) - (q[1] + p44_x*x_P_y +
    p44_y*y_P_y);
    f[11] = -(q[2] - p44_x*minus_x_P_z + p44_y*y_P_z + c17*c18*q[19]);
    f[12] = q[6] + p_B5_x - q[22]*(x_B5_y*s21 + x_B5_x*s20*c21) + (p45_y*minus_y_P_x - (q[0] +
    p45_x*x_P_x));
    f[13] = q[7] + p_B5_y + q[22]*(x_B5_x*s21 - x_B5_y*s20*c21) - (q[1] + p45_x*x_P_y +
    p45_y*y_P_y);
    f[14] = -(q[2] - p45_x*minus_x_P_z + p45_y*y_P_z + c20*c21*q[22]);
    f[15] = q[6] + p_B6_x - q[25]*(x_B6_y*s24 + x_B6_x*s23*c24) + (p46_y*minus_y_P_x - (q[0] +
    p46_x*x_P_x));
    f[16] = q[7] + p_B6_y + q[25]*(x_B6_x*s24 - x_B6_y*s23*c24) - (q[1] + p46_x*x_P_y +
    p46_y*y_P_y);
    f[17] = -(q[2] - p46_x*minus_x_P_z + p46_y*y_P_z + c23*c24*q[25]);
}

MODELER_TARGET static void MODELER_VERSION(factor)(
const modeler_lanes *J, modeler_lanes *MODELER_RESTRICT lu)
{
    const modeler_lanes t1 = 1.0/J[4];
    lu[0] = t1;
    const modeler_lanes t2 = J[12]*t1;
    const modeler_lanes t3 = 1.0/(J[13] - J[5]*t2);
    lu[1] = t3;
    const modeler_lanes t4 = 1.0/J[26];
    lu[2] = t4;
    const modeler_lanes t5 = J[34]*t4;
    const modeler_lanes t6 = 1.0/(J[35] - J[27]*t5);
    lu[3] = t6;
    const modeler_lanes t7 = 1.0/J[48];
    lu[4] = t7;
    const modeler_lanes t8 = J[56]*t7;
    const modeler_lanes t9 = 1.0/(J[57] - J[49]*t8);
    lu[5] = t9;
    const modeler_lanes t10 = 1.0/J[70];
    lu[6] = t10;
    const modeler_lanes t11 = J[78]*t10;
    const modeler_lanes t12 = 1.0/(J[79] - J[71]*t11);
    lu[7] = t12;
    const modeler_lanes t13 = 1.0/J[92];
    lu[8] = t13;
    const modeler_lanes t14 = J[100]*t13;
    const modeler_lanes t15 = 1.0/(J[101] - J[93]*t14);
    lu[9] = t15;
    const modeler_lanes t16 = 1.0/J[114];
    lu[10] = t16;
    const modeler_lanes t17 = J[122]*t16;
    const modeler_lanes t18 = 1.0/(J[123] - J[115]*t17);
    lu[11] = t18;
    const modeler_lanes t19 = J[19]*t1;
    const modeler_lanes t20 = (J[20] - J[5]*t19)*t3;
    const modeler_lanes t21 = 1.0/(t19 - t2*t20);
    lu[12] = t21;
    const modeler_lanes t22 = J[41]*t4;
    const modeler_lanes t23 = (J[42] - J[27]*t22)*t6;
    const modeler_lanes t24 = (t22 - t5*t23)*t21;
    const modeler_lanes t25 = 1.0/(1.0 - t24);
    lu[13] = -t25;
    const modeler_lanes t26 = J[63]*t7;
    const modeler_lanes t27 = (J[64] - J[49]*t26)*t9;
    const modeler_lanes t28 = (t26 - t8*t27)*t21;
    const modeler_lanes t29 = t23 - t20*t24;
    const modeler_lanes t30 = (1.0 - t28)*t25;
    const modeler_lanes t31 = 1.0/(t27 - t20*t28 - t29*t30);
    lu[14] = t31;
    const modeler_lanes t32 = J[85]*t10;
    const modeler_lanes t33 = (J[86] - J[71]*t32)*t12;
    const modeler_lanes t34 = J[16] - J[8]*t20;
    const modeler_lanes t35 = (t32 - t11*t33)*t21;
    const modeler_lanes t36 = J[38] - J[30]*t23 - t34*t24;
    const modeler_lanes t37 = (1.0 - t35)*t25;
    const modeler_lanes t38 = J[60] - J[52]*t27 - t34*t28 - t36*t30;
    const modeler_lanes t39 = (t33 - t20*t35 - t29*t37)*t31;
    const modeler_lanes t40 = 1.0/(J[82] - J[74]*t33 - t34*t35 - t36*t37 - t38*t39);
    lu[15] = t40;
    const modeler_lanes t41 = J[107]*t13;
    const modeler_lanes t42 = J[97] - J[89]*t14;
    const modeler_lanes t43 = (J[108] - J[93]*t41)*t15;
    const modeler_lanes t44 = J[9] - J[1]*t2;
    const modeler_lanes t45 = J[17] - J[1]*t19 - t44*t20;
    const modeler_lanes t46 = (t41 - t14*t43)*t21;
    const modeler_lanes t47 = J[31] - J[23]*t5;
    const modeler_lanes t48 = J[39] - J[23]*t22 - t47*t23 - t45*t24;
    const modeler_lanes t49 = (1.0 - t46)*t25;
    const modeler_lanes t50 = J[53] - J[45]*t8;
    const modeler_lanes t51 = J[61] - J[45]*t26 - t50*t27 - t45*t28 - t48*t30;
    const modeler_lanes t52 = (t43 - t20*t46 - t29*t49)*t31;
    const modeler_lanes t53 = J[75] - J[67]*t11;
    const modeler_lanes t54 = J[83] - J[67]*t32 - t53*t33 - t45*t35 - t48*t37 - t51*t39;
    const modeler_lanes t55 = (J[104] - J[96]*t43 - t34*t46 - t36*t49 - t38*t52)*t40;
    const modeler_lanes t56 = 1.0/(J[105] - J[89]*t41 - t42*t43 - t45*t46 - t48*t49 - t51*t52 -
    t54*t55);
    lu[16] = t56;
    const modeler_lanes t57 = J[129]*t16;
    const modeler_lanes t58 = J[120] - J[112]*t17;
    const modeler_lanes t59 = (J[130] - J[115]*t57)*t18;
    const modeler_lanes t60 = J[10] - J[2]*t2;
    const modeler_lanes t61 = J[18] - J[2]*t19 - t60*t20;
    const modeler_lanes t62 = (t57 - t17*t59)*t21;
    const modeler_lanes t63 = J[32] - J[24]*t5;
    const modeler_lanes t64 = J[40] - J[24]*t22 - t63*t23 - t61*t24;
    const modeler_lanes t65 = (1.0 - t62)*t25;
    const modeler_lanes t66 = J[54] - J[46]*t8;
    const modeler_lanes t67 = J[62] - J[46]*t26 - t66*t27 - t61*t28 - t64*t30;
    const modeler_lanes t68 = (t59 - t20*t62 - t29*t65)*t31;
    const modeler_lanes t69 = J[76] - J[68]*t11;
    const modeler_lanes t70 = J[84] - J[68]*t32 - t69*t33 - t61*t35 - t64*t37 - t67*t39;
    const modeler_lanes t71 = (J[126] - J[118]*t59 - t34*t62 - t36*t65 - t38*t68)*t40;
    const modeler_lanes t72 = J[98] - J[90]*t14;
    const modeler_lanes t73 = J[106] - J[90]*t41 - t72*t43 - t61*t46 - t64*t49 - t67*t52 - t70*t55;
    const modeler_lanes t74 = J[119] - J[111]*t17;
    const modeler_lanes t75 = J[127] - J[111]*t57 - t74*t59 - t45*t62 - t48*t65 - t51*t68 - t54*t71;
    const modeler_lanes t76 = t75*t56;
    const modeler_lanes t77 = J[128] - J[112]*t57 - t58*t59 - t61*t62 - t64*t65 - t67*t68 - t70*t71;
    lu[17] = 1.0/(t77 - t73*t76);
    lu[18] = J[1];
    lu[19] = J[2];
    lu[20] = J[5];
    lu[21] = t2;
    lu[22] = t19;
    lu[23] = t2;
    lu[24] = J[8];
    lu[25] = t44;
    lu[26] = t60;
    lu[27] = t20;
    lu[28] = J[23];
    lu[29] = J[24];
    lu[30] = J[27];
    lu[31] = t5;
    lu[32] = t22;
    lu[33] = t5;
    lu[34] = J[30];
    lu[35] = t47;
    lu[36] = t63;
    lu[37] = t23;
    lu[38] = J[45];
    lu[39] = J[46];
    lu[40] = J[49];
    lu[41] = t8;
    lu[42] = t26;
    lu[43] = t8;
    lu[44] = J[52];
    lu[45] = t50;
    lu[46] = t66;
    lu[47] = t27;
    lu[48] = J[67];
    lu[49] = J[68];
    lu[50] = J[71];
    lu[51] = t11;
    lu[52] = t32;
    lu[53] = t11;
    lu[54] = J[74];
    lu[55] = t53;
    lu[56] = t69;
    lu[57] = t33;
    lu[58] = J[89];
    lu[59] = J[90];
    lu[60] = J[93];
    lu[61] = t14;
    lu[62] = t41;
    lu[63] = t14;
    lu[64] = J[96];
    lu[65] = t42;
    lu[66] = t72;
    lu[67] = t43;
    lu[68] = J[111];
    lu[69] = J[112];
    lu[70] = J[115];
    lu[71] = t17;
    lu[72] = t57;
    lu[73] = t17;
    lu[74] = J[118];
    lu[75] = t74;
    lu[76] = t58;
    lu[77] = t59;
    lu[78] = t20;
    lu[79] = t34;
    lu[80] = t45;
    lu[81] = t61;
    lu[82] = t24;
    lu[83] = t28;
    lu[84] = t35;
    lu[85] = t46;
    lu[86] = t62;
    lu[87] = t29;
    lu[88] = t36;
    lu[89] = t48;
    lu[90] = t64;
    lu[91] = t30;
    lu[92] = t37;
    lu[93] = t49;
    lu[94] = t65;
    lu[95] = t38;
    lu[96] = t51;
    lu[97] = t67;
    lu[98] = t39;
    lu[99] = t52;
    lu[100] = t68;
    lu[101] = t54;
    lu[102] = t70;
    lu[103] = t55;
    lu[104] = t71;
    lu[105] = t73;
    lu[106] = t76;
}

MODELER_TARGET static void MODELER_VERSION(solve)(
const modeler_lanes *lu, const modeler_lanes *right, modeler_lanes *MODELER_RESTRICT x)
{
    const modeler_lanes t1 = right[4] - lu[31]*right[3];
    const modeler_lanes t2 = right[1] - lu[21]*right[0];
    const modeler_lanes t3 = right[2] - lu[22]*right[0] - lu[27]*t2;
    const modeler_lanes t4 = right[5] - lu[32]*right[3] - lu[37]*t1 - lu[82]*t3;
    const modeler_lanes t5 = right[7] - lu[41]*right[6];
    const modeler_lanes t6 = right[8] - lu[42]*right[6] - lu[47]*t5 - lu[83]*t3 - lu[91]*t4;
    const modeler_lanes t7 = right[10] - lu[51]*right[9];
    const modeler_lanes t8 = right[11] - lu[52]*right[9] - lu[57]*t7 - lu[84]*t3 - lu[92]*t4;
    const modeler_lanes t9 = t8 - lu[98]*t6;
    const modeler_lanes t10 = right[13] - lu[61]*right[12];
    const modeler_lanes t11 = right[14] - lu[62]*right[12] - lu[67]*t10 - lu[85]*t3 - lu[93]*t4;
    const modeler_lanes t12 = t11 - lu[99]*t6 - lu[103]*t9;
    const modeler_lanes t13 = right[16] - lu[71]*right[15];
    const modeler_lanes t14 = right[17] - lu[72]*right[15] - lu[77]*t13 - lu[86]*t3 - lu[94]*t4;
    const modeler_lanes t15 = lu[17]*(t14 - lu[100]*t6 - lu[104]*t9 - lu[106]*t12);
    const modeler_lanes t16 = lu[16]*(t12 - lu[105]*t15);
    const modeler_lanes t17 = lu[15]*(t9 - lu[101]*t16 - lu[102]*t15);
    const modeler_lanes t18 = lu[14]*(t6 - lu[95]*t17 - lu[96]*t16 - lu[97]*t15);
    const modeler_lanes t19 = lu[13]*(t4 - lu[87]*t18 - lu[88]*t17 - lu[89]*t16 - lu[90]*t15);
    const modeler_lanes t20 = lu[12]*(t3 - lu[78]*t18 + t19 - lu[79]*t17 - lu[80]*t16 - lu[81]*t15);
    x[0] = t20;
    x[1] = t18;
    x[2] = t19;
    x[3] = t17;
    x[4] = t16;
    x[5] = t15;
    const modeler_lanes t21 = lu[1]*(t2 - lu[23]*t20 + t18 - lu[24]*t17 - lu[25]*t16 - lu[26]*t15);
    x[6] = lu[0]*(right[0] + t20 - lu[18]*t16 - lu[19]*t15 - lu[20]*t21);
    x[7] = t21;
    const modeler_lanes t22 = lu[3]*(t1 - lu[33]*t20 + t18 - lu[34]*t17 - lu[35]*t16 - lu[36]*t15);
    x[8] = lu[2]*(right[3] + t20 - lu[28]*t16 - lu[29]*t15 - lu[30]*t22);
    x[9] = t22;
    const modeler_lanes t23 = lu[5]*(t5 - lu[43]*t20 + t18 - lu[44]*t17 - lu[45]*t16 - lu[46]*t15);
    x[10] = lu[4]*(right[6] + t20 - lu[38]*t16 - lu[39]*t15 - lu[40]*t23);
    x[11] = t23;
    const modeler_lanes t24 = lu[7]*(t7 - lu[53]*t20 + t18 - lu[54]*t17 - lu[55]*t16 - lu[56]*t15);
    x[12] = lu[6]*(right[9] + t20 - lu[48]*t16 - lu[49]*t15 - lu[50]*t24);
    x[13] = t24;
    const modeler_lanes t25 = lu[9]*(t10 - lu[63]*t20 + t18 - lu[64]*t17 - lu[65]*t16 - lu[66]*t15);
    x[14] = lu[8]*(right[12] + t20 - lu[58]*t16 - lu[59]*t15 - lu[60]*t25);
    x[15] = t25;
    const modeler_lanes t26 = lu[11]*(t13 - lu[73]*t20 + t18 - lu[74]*t17 - lu[75]*t16 -
    lu[76]*t15);
    x[16] = lu[10]*(right[15] + t20 - lu[68]*t16 - lu[69]*t15 - lu[70]*t26);
    x[17] = t26;
}

MODELER_TARGET static void MODELER_VERSION(coupling)(
const modeler_lanes *J, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT G)
{
    const modeler_lanes t1 = lu[22] - lu[21]*lu[27];
    const modeler_lanes t2 = lu[32] - lu[31]*lu[37] - lu[82]*t1;
    const modeler_lanes t3 = lu[42] - lu[41]*lu[47] - lu[83]*t1 - lu[91]*t2;
    const modeler_lanes t4 = lu[52] - lu[51]*lu[57] - lu[84]*t1 - lu[92]*t2 - lu[98]*t3;
    const modeler_lanes t5 = lu[62] - lu[61]*lu[67] - lu[85]*t1 - lu[93]*t2 - lu[99]*t3 -
    lu[103]*t4;
    const modeler_lanes t6 = lu[72] - lu[71]*lu[77] - lu[86]*t1 - lu[94]*t2 - lu[100]*t3 -
    lu[104]*t4;
    const modeler_lanes t7 = lu[17]*(t6 - lu[106]*t5);
    const modeler_lanes t8 = lu[16]*(t5 - lu[105]*t7);
    const modeler_lanes t9 = lu[15]*(t4 - lu[101]*t8 - lu[102]*t7);
    const modeler_lanes t10 = lu[14]*(t3 - lu[95]*t9 - lu[96]*t8 - lu[97]*t7);
    const modeler_lanes t11 = lu[13]*(t2 - lu[87]*t10 - lu[88]*t9 - lu[89]*t8 - lu[90]*t7);
    const modeler_lanes t12 = lu[12]*(t1 - lu[78]*t10 + t11 - lu[79]*t9 - lu[80]*t8 - lu[81]*t7);
    G[0] = t12;
    G[1] = t10;
    G[2] = t11;
    G[3] = t9;
    G[4] = t8;
    G[5] = t7;
    const modeler_lanes t13 = 1.0 - t12;
    const modeler_lanes t14 = lu[1]*(lu[21] - lu[23]*t12 + t10 - lu[24]*t9 - lu[25]*t8 - lu[26]*t7);
    G[6] = -lu[0]*(t13 + lu[18]*t8 + lu[19]*t7 + lu[20]*t14);
    G[7] = t14;
    const modeler_lanes t15 = lu[3]*(lu[31] - lu[33]*t12 + t10 - lu[34]*t9 - lu[35]*t8 - lu[36]*t7);
    G[8] = -lu[2]*(t13 + lu[28]*t8 + lu[29]*t7 + lu[30]*t15);
    G[9] = t15;
    const modeler_lanes t16 = lu[5]*(lu[41] - lu[43]*t12 + t10 - lu[44]*t9 - lu[45]*t8 - lu[46]*t7);
    G[10] = -lu[4]*(t13 + lu[38]*t8 + lu[39]*t7 + lu[40]*t16);
    G[11] = t16;
    const modeler_lanes t17 = lu[7]*(lu[51] - lu[53]*t12 + t10 - lu[54]*t9 - lu[55]*t8 - lu[56]*t7);
    G[12] = -lu[6]*(t13 + lu[48]*t8 + lu[49]*t7 + lu[50]*t17);
    G[13] = t17;
    const modeler_lanes t18 = lu[9]*(lu[61] - lu[63]*t12 + t10 - lu[64]*t9 - lu[65]*t8 - lu[66]*t7);
    G[14] = -lu[8]*(t13 + lu[58]*t8 + lu[59]*t7 + lu[60]*t18);
    G[15] = t18;
    const modeler_lanes t19 = lu[11]*(lu[71] - lu[73]*t12 + t10 - lu[74]*t9 - lu[75]*t8 -
    lu[76]*t7);
    G[16] = -lu[10]*(t13 + lu[68]*t8 + lu[69]*t7 + lu[70]*t19);
    G[17] = t19;
    const modeler_lanes t20 = lu[37] - lu[27]*lu[82];
    const modeler_lanes t21 = lu[47] - lu[27]*lu[83] - lu[91]*t20;
    const modeler_lanes t22 = lu[57] - lu[27]*lu[84] - lu[92]*t20 - lu[98]*t21;
    const modeler_lanes t23 = lu[67] - lu[27]*lu[85] - lu[93]*t20 - lu[99]*t21 - lu[103]*t22;
    const modeler_lanes t24 = lu[77] - lu[27]*lu[86] - lu[94]*t20 - lu[100]*t21 - lu[104]*t22;
    const modeler_lanes t25 = lu[17]*(t24 - lu[106]*t23);
    const modeler_lanes t26 = lu[16]*(t23 - lu[105]*t25);
    const modeler_lanes t27 = lu[15]*(t22 - lu[101]*t26 - lu[102]*t25);
    const modeler_lanes t28 = lu[14]*(t21 - lu[95]*t27 - lu[96]*t26 - lu[97]*t25);
    const modeler_lanes t29 = lu[13]*(t20 - lu[87]*t28 - lu[88]*t27 - lu[89]*t26 - lu[90]*t25);
    const modeler_lanes t30 = lu[12]*(lu[27] - lu[78]*t28 + t29 - lu[79]*t27 - lu[80]*t26 -
    lu[81]*t25);
    G[18] = t30;
    G[19] = t28;
    G[20] = t29;
    G[21] = t27;
    G[22] = t26;
    G[23] = t25;
    const modeler_lanes t31 = lu[1]*(t28 - (1.0 + lu[23]*t30) - lu[24]*t27 - lu[25]*t26 -
    lu[26]*t25);
    G[24] = lu[0]*(t30 - lu[18]*t26 - lu[19]*t25 - lu[20]*t31);
    G[25] = t31;
    const modeler_lanes t32 = lu[3]*(t28 - (1.0 + lu[33]*t30) - lu[34]*t27 - lu[35]*t26 -
    lu[36]*t25);
    G[26] = lu[2]*(t30 - lu[28]*t26 - lu[29]*t25 - lu[30]*t32);
    G[27] = t32;
    const modeler_lanes t33 = lu[5]*(t28 - (1.0 + lu[43]*t30) - lu[44]*t27 - lu[45]*t26 -
    lu[46]*t25);
    G[28] = lu[4]*(t30 - lu[38]*t26 - lu[39]*t25 - lu[40]*t33);
    G[29] = t33;
    const modeler_lanes t34 = lu[7]*(t28 - (1.0 + lu[53]*t30) - lu[54]*t27 - lu[55]*t26 -
    lu[56]*t25);
    G[30] = lu[6]*(t30 - lu[48]*t26 - lu[49]*t25 - lu[50]*t34);
    G[31] = t34;
    const modeler_lanes t35 = lu[9]*(t28 - (1.0 + lu[63]*t30) - lu[64]*t27 - lu[65]*t26 -
    lu[66]*t25);
    G[32] = lu[8]*(t30 - lu[58]*t26 - lu[59]*t25 - lu[60]*t35);
    G[33] = t35;
    const modeler_lanes t36 = lu[11]*(t28 - (1.0 + lu[73]*t30) - lu[74]*t27 - lu[75]*t26 -
    lu[76]*t25);
    G[34] = lu[10]*(t30 - lu[68]*t26 - lu[69]*t25 - lu[70]*t36);
    G[35] = t36;
    const modeler_lanes t37 = J[14] - J[6]*lu[21];
    const modeler_lanes t38 = J[21] - J[6]*lu[22] - lu[27]*t37;
    const modeler_lanes t39 = lu[82]*t38;
    const modeler_lanes t40 = lu[83]*t38 - lu[91]*t39;
    const modeler_lanes t41 = lu[84]*t38 - lu[92]*t39 - lu[98]*t40;
    const modeler_lanes t42 = lu[85]*t38 - lu[93]*t39 - lu[99]*t40 - lu[103]*t41;
    const modeler_lanes t43 = lu[17]*(lu[86]*t38 - lu[94]*t39 - lu[100]*t40 - lu[104]*t41 -
    lu[106]*t42);
    const modeler_lanes t44 = lu[16]*(t42 - lu[105]*t43);
    const modeler_lanes t45 = lu[15]*(t41 - lu[101]*t44 - lu[102]*t43);
    const modeler_lanes t46 = lu[14]*(t40 - lu[95]*t45 - lu[96]*t44 - lu[97]*t43);
    const modeler_lanes t47 = lu[13]*(t39 - lu[87]*t46 - lu[88]*t45 - lu[89]*t44 - lu[90]*t43);
    const modeler_lanes t48 = lu[12]*(t47 - (t38 + lu[78]*t46) - lu[79]*t45 - lu[80]*t44 -
    lu[81]*t43);
    G[36] = t48;
    G[37] = t46;
    G[38] = t47;
    G[39] = t45;
    G[40] = t44;
    G[41] = t43;
    const modeler_lanes t49 = lu[1]*(t46 - (t37 + lu[23]*t48) - lu[24]*t45 - lu[25]*t44 -
    lu[26]*t43);
    G[42] = -lu[0]*(J[6] - t48 + lu[18]*t44 + lu[19]*t43 + lu[20]*t49);
    G[43] = t49;
    const modeler_lanes t50 = lu[3]*(t46 - lu[33]*t48 - lu[34]*t45 - lu[35]*t44 - lu[36]*t43);
    G[44] = lu[2]*(t48 - lu[28]*t44 - lu[29]*t43 - lu[30]*t50);
    G[45] = t50;
    const modeler_lanes t51 = lu[5]*(t46 - lu[43]*t48 - lu[44]*t45 - lu[45]*t44 - lu[46]*t43);
    G[46] = lu[4]*(t48 - lu[38]*t44 - lu[39]*t43 - lu[40]*t51);
    G[47] = t51;
    const modeler_lanes t52 = lu[7]*(t46 - lu[53]*t48 - lu[54]*t45 - lu[55]*t44 - lu[56]*t43);
    G[48] = lu[6]*(t48 - lu[48]*t44 - lu[49]*t43 - lu[50]*t52);
    G[49] = t52;
    const modeler_lanes t53 = lu[9]*(t46 - lu[63]*t48 - lu[64]*t45 - lu[65]*t44 - lu[66]*t43);
    G[50] = lu[8]*(t48 - lu[58]*t44 - lu[59]*t43 - lu[60]*t53);
    G[51] = t53;
    const modeler_lanes t54 = lu[11]*(t46 - lu[73]*t48 - lu[74]*t45 - lu[75]*t44 - lu[76]*t43);
    G[52] = lu[10]*(t48 - lu[68]*t44 - lu[69]*t43 - lu[70]*t54);
    G[53] = t54;
    const modeler_lanes t55 = J[36] - J[28]*lu[31];
    const modeler_lanes t56 = J[43] - J[28]*lu[32] - lu[37]*t55;
    const modeler_lanes t57 = lu[91]*t56;
    const modeler_lanes t58 = lu[92]*t56 - lu[98]*t57;
    const modeler_lanes t59 = lu[93]*t56 - lu[99]*t57 - lu[103]*t58;
    const modeler_lanes t60 = lu[17]*(lu[94]*t56 - lu[100]*t57 - lu[104]*t58 - lu[106]*t59);
    const modeler_lanes t61 = lu[16]*(t59 - lu[105]*t60);
    const modeler_lanes t62 = lu[15]*(t58 - lu[101]*t61 - lu[102]*t60);
    const modeler_lanes t63 = lu[14]*(t57 - lu[95]*t62 - lu[96]*t61 - lu[97]*t60);
    const modeler_lanes t64 = lu[13]*(t56 + lu[87]*t63 + lu[88]*t62 + lu[89]*t61 + lu[90]*t60);
    const modeler_lanes t65 = lu[12]*(t64 + lu[78]*t63 + lu[79]*t62 + lu[80]*t61 + lu[81]*t60);
    G[54] = -t65;
    G[55] = t63;
    G[56] = -t64;
    G[57] = t62;
    G[58] = t61;
    G[59] = t60;
    const modeler_lanes t66 = lu[1]*(t63 + lu[23]*t65 - lu[24]*t62 - lu[25]*t61 - lu[26]*t60);
    G[60] = -lu[0]*(t65 + lu[18]*t61 + lu[19]*t60 + lu[20]*t66);
    G[61] = t66;
    const modeler_lanes t67 = lu[3]*(lu[33]*t65 - t55 + t63 - lu[34]*t62 - lu[35]*t61 - lu[36]*t60);
    G[62] = -lu[2]*(J[28] + t65 + lu[28]*t61 + lu[29]*t60 + lu[30]*t67);
    G[63] = t67;
    const modeler_lanes t68 = lu[5]*(t63 + lu[43]*t65 - lu[44]*t62 - lu[45]*t61 - lu[46]*t60);
    G[64] = -lu[4]*(t65 + lu[38]*t61 + lu[39]*t60 + lu[40]*t68);
    G[65] = t68;
    const modeler_lanes t69 = lu[7]*(t63 + lu[53]*t65 - lu[54]*t62 - lu[55]*t61 - lu[56]*t60);
    G[66] = -lu[6]*(t65 + lu[48]*t61 + lu[49]*t60 + lu[50]*t69);
    G[67] = t69;
    const modeler_lanes t70 = lu[9]*(t63 + lu[63]*t65 - lu[64]*t62 - lu[65]*t61 - lu[66]*t60);
    G[68] = -lu[8]*(t65 + lu[58]*t61 + lu[59]*t60 + lu[60]*t70);
    G[69] = t70;
    const modeler_lanes t71 = lu[11]*(t63 + lu[73]*t65 - lu[74]*t62 - lu[75]*t61 - lu[76]*t60);
    G[70] = -lu[10]*(t65 + lu[68]*t61 + lu[69]*t60 + lu[70]*t71);
    G[71] = t71;
    const modeler_lanes t72 = J[58] - J[50]*lu[41];
    const modeler_lanes t73 = J[65] - J[50]*lu[42] - lu[47]*t72;
    const modeler_lanes t74 = lu[98]*t73;
    const modeler_lanes t75 = lu[99]*t73 - lu[103]*t74;
    const modeler_lanes t76 = lu[17]*(lu[100]*t73 - lu[104]*t74 - lu[106]*t75);
    const modeler_lanes t77 = lu[16]*(t75 - lu[105]*t76);
    const modeler_lanes t78 = lu[15]*(t74 - lu[101]*t77 - lu[102]*t76);
    const modeler_lanes t79 = lu[14]*(t73 + lu[95]*t78 + lu[96]*t77 + lu[97]*t76);
    const modeler_lanes t80 = lu[13]*(lu[87]*t79 - lu[88]*t78 - lu[89]*t77 - lu[90]*t76);
    const modeler_lanes t81 = lu[12]*(t80 + lu[78]*t79 - lu[79]*t78 - lu[80]*t77 - lu[81]*t76);
    G[72] = t81;
    G[73] = -t79;
    G[74] = t80;
    G[75] = t78;
    G[76] = t77;
    G[77] = t76;
    const modeler_lanes t82 = lu[1]*(t79 + lu[23]*t81 + lu[24]*t78 + lu[25]*t77 + lu[26]*t76);
    G[78] = lu[0]*(t81 - lu[18]*t77 - lu[19]*t76 + lu[20]*t82);
    G[79] = -t82;
    const modeler_lanes t83 = lu[3]*(t79 + lu[33]*t81 + lu[34]*t78 + lu[35]*t77 + lu[36]*t76);
    G[80] = lu[2]*(t81 - lu[28]*t77 - lu[29]*t76 + lu[30]*t83);
    G[81] = -t83;
    const modeler_lanes t84 = lu[5]*(t72 + lu[43]*t81 + t79 + lu[44]*t78 + lu[45]*t77 + lu[46]*t76);
    G[82] = -lu[4]*(J[50] - t81 + lu[38]*t77 + lu[39]*t76 - lu[40]*t84);
    G[83] = -t84;
    const modeler_lanes t85 = lu[7]*(t79 + lu[53]*t81 + lu[54]*t78 + lu[55]*t77 + lu[56]*t76);
    G[84] = lu[6]*(t81 - lu[48]*t77 - lu[49]*t76 + lu[50]*t85);
    G[85] = -t85;
    const modeler_lanes t86 = lu[9]*(t79 + lu[63]*t81 + lu[64]*t78 + lu[65]*t77 + lu[66]*t76);
    G[86] = lu[8]*(t81 - lu[58]*t77 - lu[59]*t76 + lu[60]*t86);
    G[87] = -t86;
    const modeler_lanes t87 = lu[11]*(t79 + lu[73]*t81 + lu[74]*t78 + lu[75]*t77 + lu[76]*t76);
    G[88] = lu[10]*(t81 - lu[68]*t77 - lu[69]*t76 + lu[70]*t87);
    G[89] = -t87;
    const modeler_lanes t88 = J[80] - J[72]*lu[51];
    const modeler_lanes t89 = J[87] - J[72]*lu[52] - lu[57]*t88;
    const modeler_lanes t90 = lu[103]*t89;
    const modeler_lanes t91 = lu[17]*(lu[104]*t89 - lu[106]*t90);
    const modeler_lanes t92 = lu[16]*(t90 - lu[105]*t91);
    const modeler_lanes t93 = lu[15]*(t89 + lu[101]*t92 + lu[102]*t91);
    const modeler_lanes t94 = lu[14]*(lu[95]*t93 - lu[96]*t92 - lu[97]*t91);
    const modeler_lanes t95 = lu[13]*(lu[87]*t94 - lu[88]*t93 + lu[89]*t92 + lu[90]*t91);
    const modeler_lanes t96 = lu[12]*(t95 + lu[78]*t94 - lu[79]*t93 + lu[80]*t92 + lu[81]*t91);
    G[90] = -t96;
    G[91] = t94;
    G[92] = -t95;
    G[93] = -t93;
    G[94] = t92;
    G[95] = t91;
    const modeler_lanes t97 = lu[1]*(t94 + lu[23]*t96 + lu[24]*t93 - lu[25]*t92 - lu[26]*t91);
    G[96] = -lu[0]*(t96 + lu[18]*t92 + lu[19]*t91 + lu[20]*t97);
    G[97] = t97;
    const modeler_lanes t98 = lu[3]*(t94 + lu[33]*t96 + lu[34]*t93 - lu[35]*t92 - lu[36]*t91);
    G[98] = -lu[2]*(t96 + lu[28]*t92 + lu[29]*t91 + lu[30]*t98);
    G[99] = t98;
    const modeler_lanes t99 = lu[5]*(t94 + lu[43]*t96 + lu[44]*t93 - lu[45]*t92 - lu[46]*t91);
    G[100] = -lu[4]*(t96 + lu[38]*t92 + lu[39]*t91 + lu[40]*t99);
    G[101] = t99;
    const modeler_lanes t100 = lu[7]*(lu[53]*t96 - t88 + t94 + lu[54]*t93 - lu[55]*t92 -
    lu[56]*t91);
    G[102] = -lu[6]*(J[72] + t96 + lu[48]*t92 + lu[49]*t91 + lu[50]*t100);
    G[103] = t100;
    const modeler_lanes t101 = lu[9]*(t94 + lu[63]*t96 + lu[64]*t93 - lu[65]*t92 - lu[66]*t91);
    G[104] = -lu[8]*(t96 + lu[58]*t92 + lu[59]*t91 + lu[60]*t101);
    G[105] = t101;
    const modeler_lanes t102 = lu[11]*(t94 + lu[73]*t96 + lu[74]*t93 - lu[75]*t92 - lu[76]*t91);
    G[106] = -lu[10]*(t96 + lu[68]*t92 + lu[69]*t91 + lu[70]*t102);
    G[107] = t102;
    const modeler_lanes t103 = J[102] - J[94]*lu[61];
    const modeler_lanes t104 = J[109] - J[94]*lu[62] - lu[67]*t103;
    const modeler_lanes t105 = lu[106]*t104*lu[17];
    const modeler_lanes t106 = lu[16]*(t104 + lu[105]*t105);
    const modeler_lanes t107 = lu[15]*(lu[101]*t106 - lu[102]*t105);
    const modeler_lanes t108 = lu[14]*(lu[95]*t107 - lu[96]*t106 + lu[97]*t105);
    const modeler_lanes t109 = lu[13]*(lu[87]*t108 - lu[88]*t107 + lu[89]*t106 - lu[90]*t105);
    const modeler_lanes t110 = lu[12]*(t109 + lu[78]*t108 - lu[79]*t107 + lu[80]*t106 -
    lu[81]*t105);
    G[108] = t110;
    G[109] = -t108;
    G[110] = t109;
    G[111] = t107;
    G[112] = -t106;
    G[113] = t105;
    const modeler_lanes t111 = lu[1]*(t108 + lu[23]*t110 + lu[24]*t107 - lu[25]*t106 + lu[26]*t105);
    G[114] = lu[0]*(t110 + lu[18]*t106 - lu[19]*t105 + lu[20]*t111);
    G[115] = -t111;
    const modeler_lanes t112 = lu[3]*(t108 + lu[33]*t110 + lu[34]*t107 - lu[35]*t106 + lu[36]*t105);
    G[116] = lu[2]*(t110 + lu[28]*t106 - lu[29]*t105 + lu[30]*t112);
    G[117] = -t112;
    const modeler_lanes t113 = lu[5]*(t108 + lu[43]*t110 + lu[44]*t107 - lu[45]*t106 + lu[46]*t105);
    G[118] = lu[4]*(t110 + lu[38]*t106 - lu[39]*t105 + lu[40]*t113);
    G[119] = -t113;
    const modeler_lanes t114 = lu[7]*(t108 + lu[53]*t110 + lu[54]*t107 - lu[55]*t106 + lu[56]*t105);
    G[120] = lu[6]*(t110 + lu[48]*t106 - lu[49]*t105 + lu[50]*t114);
    G[121] = -t114;
    const modeler_lanes t115 = t103 + lu[63]*t110 + t108 + lu[64]*t107 - lu[65]*t106 + lu[66]*t105;
    const modeler_lanes t116 = lu[9]*t115;
    G[122] = -lu[8]*(J[94] - t110 - lu[58]*t106 + lu[59]*t105 - lu[60]*t116);
    G[123] = -t116;
    const modeler_lanes t117 = lu[11]*(t108 + lu[73]*t110 + lu[74]*t107 - lu[75]*t106 +
    lu[76]*t105);
    G[124] = lu[10]*(t110 + lu[68]*t106 - lu[69]*t105 + lu[70]*t117);
    G[125] = -t117;
    const modeler_lanes t118 = J[124] - J[116]*lu[71];
    const modeler_lanes t119 = lu[17]*(J[131] - J[116]*lu[72] - lu[77]*t118);
    const modeler_lanes t120 = lu[105]*t119*lu[16];
    const modeler_lanes t121 = lu[15]*(lu[101]*t120 - lu[102]*t119);
    const modeler_lanes t122 = lu[14]*(lu[95]*t121 - lu[96]*t120 + lu[97]*t119);
    const modeler_lanes t123 = lu[13]*(lu[87]*t122 - lu[88]*t121 + lu[89]*t120 - lu[90]*t119);
    const modeler_lanes t124 = lu[12]*(t123 + lu[78]*t122 - lu[79]*t121 + lu[80]*t120 -
    lu[81]*t119);
    G[126] = -t124;
    G[127] = t122;
    G[128] = -t123;
    G[129] = -t121;
    G[130] = t120;
    G[131] = -t119;
    const modeler_lanes t125 = lu[1]*(t122 + lu[23]*t124 + lu[24]*t121 - lu[25]*t120 + lu[26]*t119);
    G[132] = -lu[0]*(t124 + lu[18]*t120 - lu[19]*t119 + lu[20]*t125);
    G[133] = t125;
    const modeler_lanes t126 = lu[3]*(t122 + lu[33]*t124 + lu[34]*t121 - lu[35]*t120 + lu[36]*t119);
    G[134] = -lu[2]*(t124 + lu[28]*t120 - lu[29]*t119 + lu[30]*t126);
    G[135] = t126;
    const modeler_lanes t127 = lu[5]*(t122 + lu[43]*t124 + lu[44]*t121 - lu[45]*t120 + lu[46]*t119);
    G[136] = -lu[4]*(t124 + lu[38]*t120 - lu[39]*t119 + lu[40]*t127);
    G[137] = t127;
    const modeler_lanes t128 = lu[7]*(t122 + lu[53]*t124 + lu[54]*t121 - lu[55]*t120 + lu[56]*t119);
    G[138] = -lu[6]*(t124 + lu[48]*t120 - lu[49]*t119 + lu[50]*t128);
    G[139] = t128;
    const modeler_lanes t129 = lu[9]*(t122 + lu[63]*t124 + lu[64]*t121 - lu[65]*t120 + lu[66]*t119);
    G[140] = -lu[8]*(t124 + lu[58]*t120 - lu[59]*t119 + lu[60]*t129);
    G[141] = t129;
    const modeler_lanes t130 = lu[73]*t124 - t118 + t122 + lu[74]*t121 - lu[75]*t120 + lu[76]*t119;
    const modeler_lanes t131 = lu[11]*t130;
    G[142] = -lu[10]*(J[116] + t124 + lu[68]*t120 - lu[69]*t119 + lu[70]*t131);
    G[143] = t131;
}

MODELER_TARGET static void MODELER_VERSION(turned)(
const modeler_lanes *J, const modeler_lanes *K, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT x)
{
    const double k1 = fabs(1.0);
    const modeler_lanes t1 = modeler_lanes_fabs(J[16] - K[16]) + modeler_lanes_fabs(J[17] - K[17]);
    const modeler_lanes t2 = t1 + modeler_lanes_fabs(J[18] - K[18]) + modeler_lanes_fabs(J[19] -
    K[19]);
    const modeler_lanes t3 = modeler_lanes_fabs(J[1] - K[1]) + modeler_lanes_fabs(J[2] - K[2]);
    const modeler_lanes t4 = t3 + modeler_lanes_fabs(J[4] - K[4]) + modeler_lanes_fabs(J[5] - K[5]);
    const modeler_lanes t5 = modeler_lanes_fabs(J[8] - K[8]) + modeler_lanes_fabs(J[9] - K[9]);
    const modeler_lanes t6 = t5 + modeler_lanes_fabs(J[10] - K[10]) + modeler_lanes_fabs(J[12] -
    K[12]);
    const modeler_lanes t7 = t6 + modeler_lanes_fabs(J[13] - K[13]) + t4*modeler_lanes_fabs(lu[21]);
    const modeler_lanes t8 = t2 + modeler_lanes_fabs(J[20] - K[20]) + t4*modeler_lanes_fabs(lu[22]);
    const modeler_lanes t9 = t8 + t7*modeler_lanes_fabs(lu[27]);
    const modeler_lanes t10 = modeler_lanes_fabs(J[60] - K[60]) + modeler_lanes_fabs(J[61] - K[61]);
    const modeler_lanes t11 = t10 + modeler_lanes_fabs(J[62] - K[62]);
    const modeler_lanes t12 = t11 + modeler_lanes_fabs(J[63] - K[63]);
    const modeler_lanes t13 = modeler_lanes_fabs(J[45] - K[45]) + modeler_lanes_fabs(J[46] - K[46]);
    const modeler_lanes t14 = t13 + modeler_lanes_fabs(J[48] - K[48]);
    const modeler_lanes t15 = t14 + modeler_lanes_fabs(J[49] - K[49]);
    const modeler_lanes t16 = modeler_lanes_fabs(J[52] - K[52]) + modeler_lanes_fabs(J[53] - K[53]);
    const modeler_lanes t17 = t16 + modeler_lanes_fabs(J[54] - K[54]);
    const modeler_lanes t18 = t17 + modeler_lanes_fabs(J[56] - K[56]);
    const modeler_lanes t19 = t18 + modeler_lanes_fabs(J[57] - K[57]) +
    t15*modeler_lanes_fabs(lu[41]);
    const modeler_lanes t20 = t12 + modeler_lanes_fabs(J[64] - K[64]) +
    t15*modeler_lanes_fabs(lu[42]);
    const modeler_lanes t21 = modeler_lanes_fabs(J[38] - K[38]) + modeler_lanes_fabs(J[39] - K[39]);
    const modeler_lanes t22 = t21 + modeler_lanes_fabs(J[40] - K[40]);
    const modeler_lanes t23 = t22 + modeler_lanes_fabs(J[41] - K[41]);
    const modeler_lanes t24 = modeler_lanes_fabs(J[23] - K[23]) + modeler_lanes_fabs(J[24] - K[24]);
    const modeler_lanes t25 = t24 + modeler_lanes_fabs(J[26] - K[26]);
    const modeler_lanes t26 = t25 + modeler_lanes_fabs(J[27] - K[27]);
    const modeler_lanes t27 = modeler_lanes_fabs(J[30] - K[30]) + modeler_lanes_fabs(J[31] - K[31]);
    const modeler_lanes t28 = t27 + modeler_lanes_fabs(J[32] - K[32]);
    const modeler_lanes t29 = t28 + modeler_lanes_fabs(J[34] - K[34]);
    const modeler_lanes t30 = t29 + modeler_lanes_fabs(J[35] - K[35]) +
    t26*modeler_lanes_fabs(lu[31]);
    const modeler_lanes t31 = t23 + modeler_lanes_fabs(J[42] - K[42]) +
    t26*modeler_lanes_fabs(lu[32]);
    const modeler_lanes t32 = t31 + t30*modeler_lanes_fabs(lu[37]) + t9*modeler_lanes_fabs(lu[82]);
    const modeler_lanes t33 = t20 + t19*modeler_lanes_fabs(lu[47]) + t9*modeler_lanes_fabs(lu[83]);
    const modeler_lanes t34 = t33 + t32*modeler_lanes_fabs(lu[91]);
    const modeler_lanes t35 = modeler_lanes_fabs(J[82] - K[82]) + modeler_lanes_fabs(J[83] - K[83]);
    const modeler_lanes t36 = t35 + modeler_lanes_fabs(J[84] - K[84]);
    const modeler_lanes t37 = t36 + modeler_lanes_fabs(J[85] - K[85]);
    const modeler_lanes t38 = modeler_lanes_fabs(J[67] - K[67]) + modeler_lanes_fabs(J[68] - K[68]);
    const modeler_lanes t39 = t38 + modeler_lanes_fabs(J[70] - K[70]);
    const modeler_lanes t40 = t39 + modeler_lanes_fabs(J[71] - K[71]);
    const modeler_lanes t41 = modeler_lanes_fabs(J[74] - K[74]) + modeler_lanes_fabs(J[75] - K[75]);
    const modeler_lanes t42 = t41 + modeler_lanes_fabs(J[76] - K[76]);
    const modeler_lanes t43 = t42 + modeler_lanes_fabs(J[78] - K[78]);
    const modeler_lanes t44 = t43 + modeler_lanes_fabs(J[79] - K[79]) +
    t40*modeler_lanes_fabs(lu[51]);
    const modeler_lanes t45 = t37 + modeler_lanes_fabs(J[86] - K[86]) +
    t40*modeler_lanes_fabs(lu[52]);
    const modeler_lanes t46 = t45 + t44*modeler_lanes_fabs(lu[57]) + t9*modeler_lanes_fabs(lu[84]);
    const modeler_lanes t47 = t46 + t32*modeler_lanes_fabs(lu[92]) + t34*modeler_lanes_fabs(lu[98]);
    const modeler_lanes t48 = modeler_lanes_fabs(J[104] - K[104]) + modeler_lanes_fabs(J[105] -
    K[105]);
    const modeler_lanes t49 = t48 + modeler_lanes_fabs(J[106] - K[106]);
    const modeler_lanes t50 = t49 + modeler_lanes_fabs(J[107] - K[107]);
    const modeler_lanes t51 = modeler_lanes_fabs(J[89] - K[89]) + modeler_lanes_fabs(J[90] - K[90]);
    const modeler_lanes t52 = t51 + modeler_lanes_fabs(J[92] - K[92]);
    const modeler_lanes t53 = t52 + modeler_lanes_fabs(J[93] - K[93]);
    const modeler_lanes t54 = modeler_lanes_fabs(J[96] - K[96]) + modeler_lanes_fabs(J[97] - K[97]);
    const modeler_lanes t55 = t54 + modeler_lanes_fabs(J[98] - K[98]);
    const modeler_lanes t56 = t55 + modeler_lanes_fabs(J[100] - K[100]);
    const modeler_lanes t57 = t56 + modeler_lanes_fabs(J[101] - K[101]) +
    t53*modeler_lanes_fabs(lu[61]);
    const modeler_lanes t58 = t50 + modeler_lanes_fabs(J[108] - K[108]) +
    t53*modeler_lanes_fabs(lu[62]);
    const modeler_lanes t59 = t58 + t57*modeler_lanes_fabs(lu[67]) + t9*modeler_lanes_fabs(lu[85]);
    const modeler_lanes t60 = t59 + t32*modeler_lanes_fabs(lu[93]) + t34*modeler_lanes_fabs(lu[99]);
    const modeler_lanes t61 = t60 + t47*modeler_lanes_fabs(lu[103]);
    const modeler_lanes t62 = modeler_lanes_fabs(J[126] - K[126]) + modeler_lanes_fabs(J[127] -
    K[127]);
    const modeler_lanes t63 = t62 + modeler_lanes_fabs(J[128] - K[128]);
    const modeler_lanes t64 = t63 + modeler_lanes_fabs(J[129] - K[129]);
    const modeler_lanes t65 = modeler_lanes_fabs(J[111] - K[111]) + modeler_lanes_fabs(J[112] -
    K[112]);
    const modeler_lanes t66 = t65 + modeler_lanes_fabs(J[114] - K[114]);
    const modeler_lanes t67 = t66 + modeler_lanes_fabs(J[115] - K[115]);
    const modeler_lanes t68 = modeler_lanes_fabs(J[118] - K[118]) + modeler_lanes_fabs(J[119] -
    K[119]);
    const modeler_lanes t69 = t68 + modeler_lanes_fabs(J[120] - K[120]);
    const modeler_lanes t70 = t69 + modeler_lanes_fabs(J[122] - K[122]);
    const modeler_lanes t71 = t70 + modeler_lanes_fabs(J[123] - K[123]) +
    t67*modeler_lanes_fabs(lu[71]);
    const modeler_lanes t72 = t64 + modeler_lanes_fabs(J[130] - K[130]) +
    t67*modeler_lanes_fabs(lu[72]);
    const modeler_lanes t73 = t72 + t71*modeler_lanes_fabs(lu[77]) + t9*modeler_lanes_fabs(lu[86]);
    const modeler_lanes t74 = t73 + t32*modeler_lanes_fabs(lu[94]) +
    t34*modeler_lanes_fabs(lu[100]);
    const modeler_lanes t75 = t74 + t47*modeler_lanes_fabs(lu[104]) +
    t61*modeler_lanes_fabs(lu[106]);
    const modeler_lanes t76 = t75*modeler_lanes_fabs(lu[17]);
    const modeler_lanes t77 = (t61 + t76*modeler_lanes_fabs(lu[105]))*modeler_lanes_fabs(lu[16]);
    const modeler_lanes t78 = t47 + t77*modeler_lanes_fabs(lu[101]) +
    t76*modeler_lanes_fabs(lu[102]);
    const modeler_lanes t79 = t78*modeler_lanes_fabs(lu[15]);
    const modeler_lanes t80 = t34 + t79*modeler_lanes_fabs(lu[95]) + t77*modeler_lanes_fabs(lu[96]);
    const modeler_lanes t81 = (t80 + t76*modeler_lanes_fabs(lu[97]))*modeler_lanes_fabs(lu[14]);
    const modeler_lanes t82 = t32 + t81*modeler_lanes_fabs(lu[87]) + t79*modeler_lanes_fabs(lu[88]);
    const modeler_lanes t83 = t82 + t77*modeler_lanes_fabs(lu[89]) + t76*modeler_lanes_fabs(lu[90]);
    const modeler_lanes t84 = t83*modeler_lanes_fabs(lu[13]);
    const modeler_lanes t85 = t9 + t81*modeler_lanes_fabs(lu[78]) + k1*t84;
    const modeler_lanes t86 = t85 + t79*modeler_lanes_fabs(lu[79]) + t77*modeler_lanes_fabs(lu[80]);
    const modeler_lanes t87 = (t86 + t76*modeler_lanes_fabs(lu[81]))*modeler_lanes_fabs(lu[12]);
    x[0] = (5.0/3.0)*t87;
    x[1] = (5.0/3.0)*t81;
    x[2] = (5.0/3.0)*t84;
    x[3] = t79;
    x[4] = t77;
    x[5] = t76;
    const modeler_lanes t88 = k1*t87;
    const modeler_lanes t89 = k1*t81;
    const modeler_lanes t90 = t7 + t87*modeler_lanes_fabs(lu[23]) + t89 +
    t79*modeler_lanes_fabs(lu[24]);
    const modeler_lanes t91 = t90 + t77*modeler_lanes_fabs(lu[25]) + t76*modeler_lanes_fabs(lu[26]);
    const modeler_lanes t92 = t91*modeler_lanes_fabs(lu[1]);
    const modeler_lanes t93 = t4 + t88 + t77*modeler_lanes_fabs(lu[18]) +
    t76*modeler_lanes_fabs(lu[19]);
    x[6] = (t93 + t92*modeler_lanes_fabs(lu[20]))*modeler_lanes_fabs(lu[0]);
    x[7] = t92;
    const modeler_lanes t94 = t26 + t88 + t77*modeler_lanes_fabs(lu[28]);
    const modeler_lanes t95 = t30 + t87*modeler_lanes_fabs(lu[33]) + t89;
    const modeler_lanes t96 = t95 + t79*modeler_lanes_fabs(lu[34]) + t77*modeler_lanes_fabs(lu[35]);
    const modeler_lanes t97 = (t96 + t76*modeler_lanes_fabs(lu[36]))*modeler_lanes_fabs(lu[3]);
    const modeler_lanes t98 = t94 + t76*modeler_lanes_fabs(lu[29]) + t97*modeler_lanes_fabs(lu[30]);
    x[8] = t98*modeler_lanes_fabs(lu[2]);
    x[9] = t97;
    const modeler_lanes t99 = t15 + t88 + t77*modeler_lanes_fabs(lu[38]);
    const modeler_lanes t100 = t19 + t87*modeler_lanes_fabs(lu[43]) + t89;
    const modeler_lanes t101 = t100 + t79*modeler_lanes_fabs(lu[44]) +
    t77*modeler_lanes_fabs(lu[45]);
    const modeler_lanes t102 = (t101 + t76*modeler_lanes_fabs(lu[46]))*modeler_lanes_fabs(lu[5]);
    const modeler_lanes t103 = t99 + t76*modeler_lanes_fabs(lu[39]) +
    t102*modeler_lanes_fabs(lu[40]);
    x[10] = t103*modeler_lanes_fabs(lu[4]);
    x[11] = t102;
    const modeler_lanes t104 = t40 + t88 + t77*modeler_lanes_fabs(lu[48]);
    const modeler_lanes t105 = t44 + t87*modeler_lanes_fabs(lu[53]) + t89;
    const modeler_lanes t106 = t105 + t79*modeler_lanes_fabs(lu[54]) +
    t77*modeler_lanes_fabs(lu[55]);
    const modeler_lanes t107 = (t106 + t76*modeler_lanes_fabs(lu[56]))*modeler_lanes_fabs(lu[7]);
    const modeler_lanes t108 = t104 + t76*modeler_lanes_fabs(lu[49]) +
    t107*modeler_lanes_fabs(lu[50]);
    x[12] = t108*modeler_lanes_fabs(lu[6]);
    x[13] = t107;
    const modeler_lanes t109 = t53 + t88 + t77*modeler_lanes_fabs(lu[58]);
    const modeler_lanes t110 = t57 + t87*modeler_lanes_fabs(lu[63]) + t89;
    const modeler_lanes t111 = t110 + t79*modeler_lanes_fabs(lu[64]) +
    t77*modeler_lanes_fabs(lu[65]);
    const modeler_lanes t112 = (t111 + t76*modeler_lanes_fabs(lu[66]))*modeler_lanes_fabs(lu[9]);
    const modeler_lanes t113 = t109 + t76*modeler_lanes_fabs(lu[59]) +
    t112*modeler_lanes_fabs(lu[60]);
    x[14] = t113*modeler_lanes_fabs(lu[8]);
    x[15] = t112;
    const modeler_lanes t114 = t67 + t88 + t77*modeler_lanes_fabs(lu[68]);
    const modeler_lanes t115 = t71 + t87*modeler_lanes_fabs(lu[73]) + t89;
    const modeler_lanes t116 = t115 + t79*modeler_lanes_fabs(lu[74]) +
    t77*modeler_lanes_fabs(lu[75]);
    const modeler_lanes t117 = (t116 + t76*modeler_lanes_fabs(lu[76]))*modeler_lanes_fabs(lu[11]);
    const modeler_lanes t118 = t114 + t76*modeler_lanes_fabs(lu[69]) +
    t117*modeler_lanes_fabs(lu[70]);
    x[16] = t118*modeler_lanes_fabs(lu[10]);
    x[17] = t117;
}

MODELER_TARGET static void MODELER_VERSION(spread)(
const modeler_lanes *J, const modeler_lanes *K, const modeler_lanes *lu, modeler_lanes *MODELER_RESTRICT x)
{
    const modeler_lanes t1 = J[30] - K[30];
    const modeler_lanes t2 = J[8] - K[8];
    const modeler_lanes t3 = J[16] - K[16] - lu[27]*t2;
    const modeler_lanes t4 = J[38] - K[38] - lu[37]*t1 - lu[82]*t3;
    const modeler_lanes t5 = J[52] - K[52];
    const modeler_lanes t6 = J[60] - K[60] - lu[47]*t5 - lu[83]*t3 - lu[91]*t4;
    const modeler_lanes t7 = J[74] - K[74];
    const modeler_lanes t8 = J[82] - K[82] - lu[57]*t7 - lu[84]*t3 - lu[92]*t4 - lu[98]*t6;
    const modeler_lanes t9 = J[96] - K[96];
    const modeler_lanes t10 = J[104] - K[104] - lu[67]*t9 - lu[85]*t3 - lu[93]*t4 - lu[99]*t6;
    const modeler_lanes t11 = t10 - lu[103]*t8;
    const modeler_lanes t12 = J[118] - K[118];
    const modeler_lanes t13 = J[126] - K[126] - lu[77]*t12 - lu[86]*t3 - lu[94]*t4 - lu[100]*t6;
    const modeler_lanes t14 = lu[17]*(t13 - lu[104]*t8 - lu[106]*t11);
    const modeler_lanes t15 = lu[16]*(t11 - lu[105]*t14);
    const modeler_lanes t16 = lu[15]*(t8 - lu[101]*t15 - lu[102]*t14);
    const modeler_lanes t17 = lu[14]*(t6 - lu[95]*t16 - lu[96]*t15 - lu[97]*t14);
    const modeler_lanes t18 = lu[13]*(t4 - lu[87]*t17 - lu[88]*t16 - lu[89]*t15 - lu[90]*t14);
    const modeler_lanes t19 = lu[12]*(t3 - lu[78]*t17 + t18 - lu[79]*t16 - lu[80]*t15 - lu[81]*t14);
    const modeler_lanes t20 = (5.0/3.0)*t19;
    const modeler_lanes t21 = (5.0/3.0)*t17;
    const modeler_lanes t22 = (5.0/3.0)*t18;
    const modeler_lanes t23 = lu[1]*(t2 - lu[23]*t19 + t17 - lu[24]*t16 - lu[25]*t15 - lu[26]*t14);
    const modeler_lanes t24 = lu[0]*(t19 - lu[18]*t15 - lu[19]*t14 - lu[20]*t23);
    const modeler_lanes t25 = t20*t20 + t21*t21 + t22*t22 + t16*t16 + t15*t15 + t14*t14 + t24*t24;
    const modeler_lanes t26 = lu[3]*(t1 - lu[33]*t19 + t17 - lu[34]*t16 - lu[35]*t15 - lu[36]*t14);
    const modeler_lanes t27 = lu[2]*(t19 - lu[28]*t15 - lu[29]*t14 - lu[30]*t26);
    const modeler_lanes t28 = lu[5]*(t5 - lu[43]*t19 + t17 - lu[44]*t16 - lu[45]*t15 - lu[46]*t14);
    const modeler_lanes t29 = lu[4]*(t19 - lu[38]*t15 - lu[39]*t14 - lu[40]*t28);
    const modeler_lanes t30 = lu[7]*(t7 - lu[53]*t19 + t17 - lu[54]*t16 - lu[55]*t15 - lu[56]*t14);
    const modeler_lanes t31 = lu[6]*(t19 - lu[48]*t15 - lu[49]*t14 - lu[50]*t30);
    const modeler_lanes t32 = lu[9]*(t9 - lu[63]*t19 + t17 - lu[64]*t16 - lu[65]*t15 - lu[66]*t14);
    const modeler_lanes t33 = lu[8]*(t19 - lu[58]*t15 - lu[59]*t14 - lu[60]*t32);
    const modeler_lanes t34 = t25 + t23*t23 + t27*t27 + t26*t26 + t29*t29 + t28*t28 + t31*t31 +
    t30*t30;
    const modeler_lanes t35 = lu[11]*(t12 - lu[73]*t19 + t17 - lu[74]*t16 - lu[75]*t15 -
    lu[76]*t14);
    const modeler_lanes t36 = lu[10]*(t19 - lu[68]*t15 - lu[69]*t14 - lu[70]*t35);
    const modeler_lanes t37 = J[23] - K[23];
    const modeler_lanes t38 = J[31] - K[31] - lu[31]*t37;
    const modeler_lanes t39 = J[1] - K[1];
    const modeler_lanes t40 = J[9] - K[9] - lu[21]*t39;
    const modeler_lanes t41 = J[17] - K[17] - lu[22]*t39 - lu[27]*t40;
    const modeler_lanes t42 = J[39] - K[39] - lu[32]*t37 - lu[37]*t38 - lu[82]*t41;
    const modeler_lanes t43 = J[45] - K[45];
    const modeler_lanes t44 = J[53] - K[53] - lu[41]*t43;
    const modeler_lanes t45 = J[61] - K[61] - lu[42]*t43 - lu[47]*t44 - lu[83]*t41 - lu[91]*t42;
    const modeler_lanes t46 = J[67] - K[67];
    const modeler_lanes t47 = J[75] - K[75] - lu[51]*t46;
    const modeler_lanes t48 = J[83] - K[83] - lu[52]*t46 - lu[57]*t47 - lu[84]*t41 - lu[92]*t42;
    const modeler_lanes t49 = t48 - lu[98]*t45;
    const modeler_lanes t50 = J[89] - K[89];
    const modeler_lanes t51 = J[97] - K[97] - lu[61]*t50;
    const modeler_lanes t52 = J[105] - K[105] - lu[62]*t50 - lu[67]*t51 - lu[85]*t41 - lu[93]*t42;
    const modeler_lanes t53 = t52 - lu[99]*t45 - lu[103]*t49;
    const modeler_lanes t54 = J[111] - K[111];
    const modeler_lanes t55 = J[119] - K[119] - lu[71]*t54;
    const modeler_lanes t56 = J[127] - K[127] - lu[72]*t54 - lu[77]*t55 - lu[86]*t41 - lu[94]*t42;
    const modeler_lanes t57 = lu[17]*(t56 - lu[100]*t45 - lu[104]*t49 - lu[106]*t53);
    const modeler_lanes t58 = lu[16]*(t53 - lu[105]*t57);
    const modeler_lanes t59 = lu[15]*(t49 - lu[101]*t58 - lu[102]*t57);
    const modeler_lanes t60 = lu[14]*(t45 - lu[95]*t59 - lu[96]*t58 - lu[97]*t57);
    const modeler_lanes t61 = lu[13]*(t42 - lu[87]*t60 - lu[88]*t59 - lu[89]*t58 - lu[90]*t57);
    const modeler_lanes t62 = lu[12]*(t41 - lu[78]*t60 + t61 - lu[79]*t59 - lu[80]*t58 -
    lu[81]*t57);
    const modeler_lanes t63 = (5.0/3.0)*t62;
    const modeler_lanes t64 = (5.0/3.0)*t60;
    const modeler_lanes t65 = (5.0/3.0)*t61;
    const modeler_lanes t66 = t34 + t33*t33 + t32*t32 + t36*t36 + t35*t35 + t63*t63 + t64*t64 +
    t65*t65;
    const modeler_lanes t67 = lu[1]*(t40 - lu[23]*t62 + t60 - lu[24]*t59 - lu[25]*t58 - lu[26]*t57);
    const modeler_lanes t68 = lu[0]*(t39 + t62 - lu[18]*t58 - lu[19]*t57 - lu[20]*t67);
    const modeler_lanes t69 = lu[3]*(t38 - lu[33]*t62 + t60 - lu[34]*t59 - lu[35]*t58 - lu[36]*t57);
    const modeler_lanes t70 = lu[2]*(t37 + t62 - lu[28]*t58 - lu[29]*t57 - lu[30]*t69);
    const modeler_lanes t71 = lu[5]*(t44 - lu[43]*t62 + t60 - lu[44]*t59 - lu[45]*t58 - lu[46]*t57);
    const modeler_lanes t72 = lu[4]*(t43 + t62 - lu[38]*t58 - lu[39]*t57 - lu[40]*t71);
    const modeler_lanes t73 = t66 + t59*t59 + t58*t58 + t57*t57 + t68*t68 + t67*t67 + t70*t70 +
    t69*t69;
    const modeler_lanes t74 = lu[7]*(t47 - lu[53]*t62 + t60 - lu[54]*t59 - lu[55]*t58 - lu[56]*t57);
    const modeler_lanes t75 = lu[6]*(t46 + t62 - lu[48]*t58 - lu[49]*t57 - lu[50]*t74);
    const modeler_lanes t76 = lu[9]*(t51 - lu[63]*t62 + t60 - lu[64]*t59 - lu[65]*t58 - lu[66]*t57);
    const modeler_lanes t77 = lu[8]*(t50 + t62 - lu[58]*t58 - lu[59]*t57 - lu[60]*t76);
    const modeler_lanes t78 = lu[11]*(t55 - lu[73]*t62 + t60 - lu[74]*t59 - lu[75]*t58 -
    lu[76]*t57);
    const modeler_lanes t79 = lu[10]*(t54 + t62 - lu[68]*t58 - lu[69]*t57 - lu[70]*t78);
    const modeler_lanes t80 = t73 + t72*t72 + t71*t71 + t75*t75 + t74*t74 + t77*t77 + t76*t76 +
    t79*t79;
    const modeler_lanes t81 = J[24] - K[24];
    const modeler_lanes t82 = J[32] - K[32] - lu[31]*t81;
    const modeler_lanes t83 = J[2] - K[2];
    const modeler_lanes t84 = J[10] - K[10] - lu[21]*t83;
    const modeler_lanes t85 = J[18] - K[18] - lu[22]*t83 - lu[27]*t84;
    const modeler_lanes t86 = J[40] - K[40] - lu[32]*t81 - lu[37]*t82 - lu[82]*t85;
    const modeler_lanes t87 = J[46] - K[46];
    const modeler_lanes t88 = J[54] - K[54] - lu[41]*t87;
    const modeler_lanes t89 = J[62] - K[62] - lu[42]*t87 - lu[47]*t88 - lu[83]*t85 - lu[91]*t86;
    const modeler_lanes t90 = J[68] - K[68];
    const modeler_lanes t91 = J[76] - K[76] - lu[51]*t90;
    const modeler_lanes t92 = J[84] - K[84] - lu[52]*t90 - lu[57]*t91 - lu[84]*t85 - lu[92]*t86;
    const modeler_lanes t93 = t92 - lu[98]*t89;
    const modeler_lanes t94 = J[90] - K[90];
    const modeler_lanes t95 = J[98] - K[98] - lu[61]*t94;
    const modeler_lanes t96 = J[106] - K[106] - lu[62]*t94 - lu[67]*t95 - lu[85]*t85 - lu[93]*t86;
    const modeler_lanes t97 = t96 - lu[99]*t89 - lu[103]*t93;
    const modeler_lanes t98 = J[112] - K[112];
    const modeler_lanes t99 = J[120] - K[120] - lu[71]*t98;
    const modeler_lanes t100 = J[128] - K[128] - lu[72]*t98 - lu[77]*t99 - lu[86]*t85 - lu[94]*t86;
    const modeler_lanes t101 = lu[17]*(t100 - lu[100]*t89 - lu[104]*t93 - lu[106]*t97);
    const modeler_lanes t102 = lu[16]*(t97 - lu[105]*t101);
    const modeler_lanes t103 = lu[15]*(t93 - lu[101]*t102 - lu[102]*t101);
    const modeler_lanes t104 = lu[14]*(t89 - lu[95]*t103 - lu[96]*t102 - lu[97]*t101);
    const modeler_lanes t105 = lu[13]*(t86 - lu[87]*t104 - lu[88]*t103 - lu[89]*t102 - lu[90]*t101);
    const modeler_lanes t106 = t85 - lu[78]*t104 + t105 - lu[79]*t103 - lu[80]*t102 - lu[81]*t101;
    const modeler_lanes t107 = lu[12]*t106;
    const modeler_lanes t108 = (5.0/3.0)*t107;
    const modeler_lanes t109 = (5.0/3.0)*t104;
    const modeler_lanes t110 = (5.0/3.0)*t105;
    const modeler_lanes t111 = t80 + t78*t78 + t108*t108 + t109*t109 + t110*t110 + t103*t103 +
    t102*t102;
    const modeler_lanes t112 = lu[1]*(t84 - lu[23]*t107 + t104 - lu[24]*t103 - lu[25]*t102 -
    lu[26]*t101);
    const modeler_lanes t113 = lu[0]*(t83 + t107 - lu[18]*t102 - lu[19]*t101 - lu[20]*t112);
    const modeler_lanes t114 = lu[3]*(t82 - lu[33]*t107 + t104 - lu[34]*t103 - lu[35]*t102 -
    lu[36]*t101);
    const modeler_lanes t115 = lu[2]*(t81 + t107 - lu[28]*t102 - lu[29]*t101 - lu[30]*t114);
    const modeler_lanes t116 = lu[5]*(t88 - lu[43]*t107 + t104 - lu[44]*t103 - lu[45]*t102 -
    lu[46]*t101);
    const modeler_lanes t117 = lu[4]*(t87 + t107 - lu[38]*t102 - lu[39]*t101 - lu[40]*t116);
    const modeler_lanes t118 = t111 + t101*t101 + t113*t113 + t112*t112 + t115*t115 + t114*t114;
    const modeler_lanes t119 = lu[7]*(t91 - lu[53]*t107 + t104 - lu[54]*t103 - lu[55]*t102 -
    lu[56]*t101);
    const modeler_lanes t120 = lu[6]*(t90 + t107 - lu[48]*t102 - lu[49]*t101 - lu[50]*t119);
    const modeler_lanes t121 = lu[9]*(t95 - lu[63]*t107 + t104 - lu[64]*t103 - lu[65]*t102 -
    lu[66]*t101);
    const modeler_lanes t122 = lu[8]*(t94 + t107 - lu[58]*t102 - lu[59]*t101 - lu[60]*t121);
    const modeler_lanes t123 = t118 + t117*t117 + t116*t116 + t120*t120 + t119*t119 + t122*t122;
    const modeler_lanes t124 = t99 - lu[73]*t107 + t104 - lu[74]*t103 - lu[75]*t102 - lu[76]*t101;
    const modeler_lanes t125 = lu[11]*t124;
    const modeler_lanes t126 = lu[10]*(t98 + t107 - lu[68]*t102 - lu[69]*t101 - lu[70]*t125);
    const modeler_lanes t127 = J[4] - K[4];
    const modeler_lanes t128 = J[12] - K[12] - lu[21]*t127;
    const modeler_lanes t129 = J[19] - K[19] - lu[22]*t127 - lu[27]*t128;
    const modeler_lanes t130 = lu[82]*t129;
    const modeler_lanes t131 = lu[83]*t129 - lu[91]*t130;
    const modeler_lanes t132 = lu[84]*t129 - lu[92]*t130 - lu[98]*t131;
    const modeler_lanes t133 = lu[85]*t129 - lu[93]*t130 - lu[99]*t131 - lu[103]*t132;
    const modeler_lanes t134 = lu[86]*t129 - lu[94]*t130 - lu[100]*t131 - lu[104]*t132 -
    lu[106]*t133;
    const modeler_lanes t135 = lu[17]*t134;
    const modeler_lanes t136 = lu[16]*(t133 - lu[105]*t135);
    const modeler_lanes t137 = lu[15]*(t132 - lu[101]*t136 - lu[102]*t135);
    const modeler_lanes t138 = lu[14]*(t131 - lu[95]*t137 - lu[96]*t136 - lu[97]*t135);
    const modeler_lanes t139 = lu[13]*(t130 - lu[87]*t138 - lu[88]*t137 - lu[89]*t136 -
    lu[90]*t135);
    const modeler_lanes t140 = t139 - (t129 + lu[78]*t138) - lu[79]*t137 - lu[80]*t136 -
    lu[81]*t135;
    const modeler_lanes t141 = lu[12]*t140;
    const modeler_lanes t142 = (5.0/3.0)*t141;
    const modeler_lanes t143 = (5.0/3.0)*t138;
    const modeler_lanes t144 = (5.0/3.0)*t139;
    const modeler_lanes t145 = t123 + t121*t121 + t126*t126 + t125*t125 + t142*t142 + t143*t143;
    const modeler_lanes t146 = t138 - (t128 + lu[23]*t141) - lu[24]*t137 - lu[25]*t136 -
    lu[26]*t135;
    const modeler_lanes t147 = lu[1]*t146;
    const modeler_lanes t148 = lu[0]*(t127 - t141 + lu[18]*t136 + lu[19]*t135 + lu[20]*t147);
    const modeler_lanes t149 = t145 + t144*t144 + t137*t137 + t136*t136 + t135*t135 + t148*t148;
    const modeler_lanes t150 = lu[3]*(t138 - lu[33]*t141 - lu[34]*t137 - lu[35]*t136 - lu[36]*t135);
    const modeler_lanes t151 = lu[2]*(t141 - lu[28]*t136 - lu[29]*t135 - lu[30]*t150);
    const modeler_lanes t152 = lu[5]*(t138 - lu[43]*t141 - lu[44]*t137 - lu[45]*t136 - lu[46]*t135);
    const modeler_lanes t153 = lu[4]*(t141 - lu[38]*t136 - lu[39]*t135 - lu[40]*t152);
    const modeler_lanes t154 = lu[7]*(t138 - lu[53]*t141 - lu[54]*t137 - lu[55]*t136 - lu[56]*t135);
    const modeler_lanes t155 = lu[6]*(t141 - lu[48]*t136 - lu[49]*t135 - lu[50]*t154);
    const modeler_lanes t156 = t149 + t147*t147 + t151*t151 + t150*t150 + t153*t153 + t152*t152;
    const modeler_lanes t157 = lu[9]*(t138 - lu[63]*t141 - lu[64]*t137 - lu[65]*t136 - lu[66]*t135);
    const modeler_lanes t158 = lu[8]*(t141 - lu[58]*t136 - lu[59]*t135 - lu[60]*t157);
    const modeler_lanes t159 = lu[11]*(t138 - lu[73]*t141 - lu[74]*t137 - lu[75]*t136 -
    lu[76]*t135);
    const modeler_lanes t160 = lu[10]*(t141 - lu[68]*t136 - lu[69]*t135 - lu[70]*t159);
    const modeler_lanes t161 = t156 + t155*t155 + t154*t154 + t158*t158 + t157*t157 + t160*t160;
    const modeler_lanes t162 = J[5] - K[5];
    const modeler_lanes t163 = J[13] - K[13] - lu[21]*t162;
    const modeler_lanes t164 = J[20] - K[20] - lu[22]*t162 - lu[27]*t163;
    const modeler_lanes t165 = lu[82]*t164;
    const modeler_lanes t166 = lu[83]*t164 - lu[91]*t165;
    const modeler_lanes t167 = lu[84]*t164 - lu[92]*t165 - lu[98]*t166;
    const modeler_lanes t168 = lu[85]*t164 - lu[93]*t165 - lu[99]*t166 - lu[103]*t167;
    const modeler_lanes t169 = lu[86]*t164 - lu[94]*t165 - lu[100]*t166 - lu[104]*t167 -
    lu[106]*t168;
    const modeler_lanes t170 = lu[17]*t169;
    const modeler_lanes t171 = lu[16]*(t168 - lu[105]*t170);
    const modeler_lanes t172 = lu[15]*(t167 - lu[101]*t171 - lu[102]*t170);
    const modeler_lanes t173 = lu[14]*(t166 - lu[95]*t172 - lu[96]*t171 - lu[97]*t170);
    const modeler_lanes t174 = lu[13]*(t165 - lu[87]*t173 - lu[88]*t172 - lu[89]*t171 -
    lu[90]*t170);
    const modeler_lanes t175 = t174 - (t164 + lu[78]*t173) - lu[79]*t172 - lu[80]*t171 -
    lu[81]*t170;
    const modeler_lanes t176 = lu[12]*t175;
    const modeler_lanes t177 = (5.0/3.0)*t176;
    const modeler_lanes t178 = (5.0/3.0)*t173;
    const modeler_lanes t179 = (5.0/3.0)*t174;
    const modeler_lanes t180 = t161 + t159*t159 + t177*t177 + t178*t178 + t179*t179 + t172*t172;
    const modeler_lanes t181 = t173 - (t163 + lu[23]*t176) - lu[24]*t172 - lu[25]*t171 -
    lu[26]*t170;
    const modeler_lanes t182 = lu[1]*t181;
    const modeler_lanes t183 = lu[0]*(t162 - t176 + lu[18]*t171 + lu[19]*t170 + lu[20]*t182);
    const modeler_lanes t184 = lu[3]*(t173 - lu[33]*t176 - lu[34]*t172 - lu[35]*t171 - lu[36]*t170);
    const modeler_lanes t185 = lu[2]*(t176 - lu[28]*t171 - lu[29]*t170 - lu[30]*t184);
    const modeler_lanes t186 = t180 + t171*t171 + t170*t170 + t183*t183 + t182*t182 + t185*t185;
    const modeler_lanes t187 = lu[5]*(t173 - lu[43]*t176 - lu[44]*t172 - lu[45]*t171 - lu[46]*t170);
    const modeler_lanes t188 = lu[4]*(t176 - lu[38]*t171 - lu[39]*t170 - lu[40]*t187);
    const modeler_lanes t189 = lu[7]*(t173 - lu[53]*t176 - lu[54]*t172 - lu[55]*t171 - lu[56]*t170);
    const modeler_lanes t190 = lu[6]*(t176 - lu[48]*t171 - lu[49]*t170 - lu[50]*t189);
    const modeler_lanes t191 = lu[9]*(t173 - lu[63]*t176 - lu[64]*t172 - lu[65]*t171 - lu[66]*t170);
    const modeler_lanes t192 = lu[8]*(t176 - lu[58]*t171 - lu[59]*t170 - lu[60]*t191);
    const modeler_lanes t193 = t186 + t184*t184 + t188*t188 + t187*t187 + t190*t190 + t189*t189;
    const modeler_lanes t194 = lu[11]*(t173 - lu[73]*t176 - lu[74]*t172 - lu[75]*t171 -
    lu[76]*t170);
    const modeler_lanes t195 = lu[10]*(t176 - lu[68]*t171 - lu[69]*t170 - lu[70]*t194);
    const modeler_lanes t196 = J[26] - K[26];
    const modeler_lanes t197 = J[34] - K[34] - lu[31]*t196;
    const modeler_lanes t198 = J[41] - K[41] - lu[32]*t196 - lu[37]*t197;
    const modeler_lanes t199 = lu[91]*t198;
    const modeler_lanes t200 = lu[92]*t198 - lu[98]*t199;
    const modeler_lanes t201 = lu[93]*t198 - lu[99]*t199 - lu[103]*t200;
    const modeler_lanes t202 = lu[17]*(lu[94]*t198 - lu[100]*t199 - lu[104]*t200 - lu[106]*t201);
    const modeler_lanes t203 = lu[16]*(t201 - lu[105]*t202);
    const modeler_lanes t204 = lu[15]*(t200 - lu[101]*t203 - lu[102]*t202);
    const modeler_lanes t205 = lu[14]*(t199 - lu[95]*t204 - lu[96]*t203 - lu[97]*t202);
    const modeler_lanes t206 = lu[13]*(t198 + lu[87]*t205 + lu[88]*t204 + lu[89]*t203 +
    lu[90]*t202);
    const modeler_lanes t207 = lu[12]*(t206 + lu[78]*t205 + lu[79]*t204 + lu[80]*t203 +
    lu[81]*t202);
    const modeler_lanes t208 = (5.0/3.0)*t207;
    const modeler_lanes t209 = (5.0/3.0)*t205;
    const modeler_lanes t210 = t193 + t192*t192 + t191*t191 + t195*t195 + t194*t194 + t208*t208;
    const modeler_lanes t211 = (5.0/3.0)*t206;
    const modeler_lanes t212 = lu[1]*(t205 + lu[23]*t207 - lu[24]*t204 - lu[25]*t203 - lu[26]*t202);
    const modeler_lanes t213 = lu[0]*(t207 + lu[18]*t203 + lu[19]*t202 + lu[20]*t212);
    const modeler_lanes t214 = t210 + t209*t209 + t211*t211 + t204*t204 + t203*t203 + t202*t202;
    const modeler_lanes t215 = lu[33]*t207 - t197 + t205 - lu[34]*t204 - lu[35]*t203 - lu[36]*t202;
    const modeler_lanes t216 = lu[3]*t215;
    const modeler_lanes t217 = lu[2]*(t196 + t207 + lu[28]*t203 + lu[29]*t202 + lu[30]*t216);
    const modeler_lanes t218 = lu[5]*(t205 + lu[43]*t207 - lu[44]*t204 - lu[45]*t203 - lu[46]*t202);
    const modeler_lanes t219 = lu[4]*(t207 + lu[38]*t203 + lu[39]*t202 + lu[40]*t218);
    const modeler_lanes t220 = t214 + t213*t213 + t212*t212 + t217*t217 + t216*t216 + t219*t219;
    const modeler_lanes t221 = lu[7]*(t205 + lu[53]*t207 - lu[54]*t204 - lu[55]*t203 - lu[56]*t202);
    const modeler_lanes t222 = lu[6]*(t207 + lu[48]*t203 + lu[49]*t202 + lu[50]*t221);
    const modeler_lanes t223 = lu[9]*(t205 + lu[63]*t207 - lu[64]*t204 - lu[65]*t203 - lu[66]*t202);
    const modeler_lanes t224 = lu[8]*(t207 + lu[58]*t203 + lu[59]*t202 + lu[60]*t223);
    const modeler_lanes t225 = lu[11]*(t205 + lu[73]*t207 - lu[74]*t204 - lu[75]*t203 -
    lu[76]*t202);
    const modeler_lanes t226 = lu[10]*(t207 + lu[68]*t203 + lu[69]*t202 + lu[70]*t225);
    const modeler_lanes t227 = t220 + t218*t218 + t222*t222 + t221*t221 + t224*t224 + t223*t223;
    const modeler_lanes t228 = J[27] - K[27];
    const modeler_lanes t229 = J[35] - K[35] - lu[31]*t228;
    const modeler_lanes t230 = J[42] - K[42] - lu[32]*t228 - lu[37]*t229;
    const modeler_lanes t231 = lu[91]*t230;
    const modeler_lanes t232 = lu[92]*t230 - lu[98]*t231;
    const modeler_lanes t233 = lu[93]*t230 - lu[99]*t231 - lu[103]*t232;
    const modeler_lanes t234 = lu[17]*(lu[94]*t230 - lu[100]*t231 - lu[104]*t232 - lu[106]*t233);
    const modeler_lanes t235 = lu[16]*(t233 - lu[105]*t234);
    const modeler_lanes t236 = lu[15]*(t232 - lu[101]*t235 - lu[102]*t234);
    const modeler_lanes t237 = lu[14]*(t231 - lu[95]*t236 - lu[96]*t235 - lu[97]*t234);
    const modeler_lanes t238 = lu[13]*(t230 + lu[87]*t237 + lu[88]*t236 + lu[89]*t235 +
    lu[90]*t234);
    const modeler_lanes t239 = lu[12]*(t238 + lu[78]*t237 + lu[79]*t236 + lu[80]*t235 +
    lu[81]*t234);
    const modeler_lanes t240 = (5.0/3.0)*t239;
    const modeler_lanes t241 = (5.0/3.0)*t237;
    const modeler_lanes t242 = (5.0/3.0)*t238;
    const modeler_lanes t243 = t227 + t226*t226 + t225*t225 + t240*t240 + t241*t241 + t242*t242;
    const modeler_lanes t244 = lu[1]*(t237 + lu[23]*t239 - lu[24]*t236 - lu[25]*t235 - lu[26]*t234);
    const modeler_lanes t245 = lu[0]*(t239 + lu[18]*t235 + lu[19]*t234 + lu[20]*t244);
    const modeler_lanes t246 = lu[33]*t239 - t229 + t237 - lu[34]*t236 - lu[35]*t235 - lu[36]*t234;
    const modeler_lanes t247 = lu[3]*t246;
    const modeler_lanes t248 = lu[2]*(t228 + t239 + lu[28]*t235 + lu[29]*t234 + lu[30]*t247);
    const modeler_lanes t249 = t243 + t236*t236 + t235*t235 + t234*t234 + t245*t245 + t244*t244;
    const modeler_lanes t250 = lu[5]*(t237 + lu[43]*t239 - lu[44]*t236 - lu[45]*t235 - lu[46]*t234);
    const modeler_lanes t251 = lu[4]*(t239 + lu[38]*t235 + lu[39]*t234 + lu[40]*t250);
    const modeler_lanes t252 = lu[7]*(t237 + lu[53]*t239 - lu[54]*t236 - lu[55]*t235 - lu[56]*t234);
    const modeler_lanes t253 = lu[6]*(t239 + lu[48]*t235 + lu[49]*t234 + lu[50]*t252);
    const modeler_lanes t254 = t249 + t248*t248 + t247*t247 + t251*t251 + t250*t250 + t253*t253;
    const modeler_lanes t255 = lu[9]*(t237 + lu[63]*t239 - lu[64]*t236 - lu[65]*t235 - lu[66]*t234);
    const modeler_lanes t256 = lu[8]*(t239 + lu[58]*t235 + lu[59]*t234 + lu[60]*t255);
    const modeler_lanes t257 = lu[11]*(t237 + lu[73]*t239 - lu[74]*t236 - lu[75]*t235 -
    lu[76]*t234);
    const modeler_lanes t258 = lu[10]*(t239 + lu[68]*t235 + lu[69]*t234 + lu[70]*t257);
    const modeler_lanes t259 = J[48] - K[48];
    const modeler_lanes t260 = J[56] - K[56] - lu[41]*t259;
    const modeler_lanes t261 = J[63] - K[63] - lu[42]*t259 - lu[47]*t260;
    const modeler_lanes t262 = lu[98]*t261;
    const modeler_lanes t263 = lu[99]*t261 - lu[103]*t262;
    const modeler_lanes t264 = lu[17]*(lu[100]*t261 - lu[104]*t262 - lu[106]*t263);
    const modeler_lanes t265 = lu[16]*(t263 - lu[105]*t264);
    const modeler_lanes t266 = lu[15]*(t262 - lu[101]*t265 - lu[102]*t264);
    const modeler_lanes t267 = lu[14]*(t261 + lu[95]*t266 + lu[96]*t265 + lu[97]*t264);
    const modeler_lanes t268 = lu[13]*(lu[87]*t267 - lu[88]*t266 - lu[89]*t265 - lu[90]*t264);
    const modeler_lanes t269 = lu[12]*(t268 + lu[78]*t267 - lu[79]*t266 - lu[80]*t265 -
    lu[81]*t264);
    const modeler_lanes t270 = (5.0/3.0)*t269;
    const modeler_lanes t271 = t254 + t252*t252 + t256*t256 + t255*t255 + t258*t258 + t257*t257;
    const modeler_lanes t272 = (5.0/3.0)*t267;
    const modeler_lanes t273 = (5.0/3.0)*t268;
    const modeler_lanes t274 = t271 + t270*t270 + t272*t272 + t273*t273 + t266*t266 + t265*t265;
    const modeler_lanes t275 = lu[1]*(t267 + lu[23]*t269 + lu[24]*t266 + lu[25]*t265 + lu[26]*t264);
    const modeler_lanes t276 = lu[0]*(t269 - lu[18]*t265 - lu[19]*t264 + lu[20]*t275);
    const modeler_lanes t277 = lu[3]*(t267 + lu[33]*t269 + lu[34]*t266 + lu[35]*t265 + lu[36]*t264);
    const modeler_lanes t278 = lu[2]*(t269 - lu[28]*t265 - lu[29]*t264 + lu[30]*t277);
    const modeler_lanes t279 = t260 + lu[43]*t269 + t267 + lu[44]*t266 + lu[45]*t265 + lu[46]*t264;
    const modeler_lanes t280 = lu[5]*t279;
    const modeler_lanes t281 = lu[4]*(t259 - t269 + lu[38]*t265 + lu[39]*t264 - lu[40]*t280);
    const modeler_lanes t282 = t274 + t264*t264 + t276*t276 + t275*t275 + t278*t278 + t277*t277;
    const modeler_lanes t283 = lu[7]*(t267 + lu[53]*t269 + lu[54]*t266 + lu[55]*t265 + lu[56]*t264);
    const modeler_lanes t284 = lu[6]*(t269 - lu[48]*t265 - lu[49]*t264 + lu[50]*t283);
    const modeler_lanes t285 = lu[9]*(t267 + lu[63]*t269 + lu[64]*t266 + lu[65]*t265 + lu[66]*t264);
    const modeler_lanes t286 = lu[8]*(t269 - lu[58]*t265 - lu[59]*t264 + lu[60]*t285);
    const modeler_lanes t287 = t282 + t281*t281 + t280*t280 + t284*t284 + t283*t283 + t286*t286;
    const modeler_lanes t288 = lu[11]*(t267 + lu[73]*t269 + lu[74]*t266 + lu[75]*t265 +
    lu[76]*t264);
    const modeler_lanes t289 = lu[10]*(t269 - lu[68]*t265 - lu[69]*t264 + lu[70]*t288);
    const modeler_lanes t290 = J[49] - K[49];
    const modeler_lanes t291 = J[57] - K[57] - lu[41]*t290;
    const modeler_lanes t292 = J[64] - K[64] - lu[42]*t290 - lu[47]*t291;
    const modeler_lanes t293 = lu[98]*t292;
    const modeler_lanes t294 = lu[99]*t292 - lu[103]*t293;
    const modeler_lanes t295 = lu[17]*(lu[100]*t292 - lu[104]*t293 - lu[106]*t294);
    const modeler_lanes t296 = lu[16]*(t294 - lu[105]*t295);
    const modeler_lanes t297 = lu[15]*(t293 - lu[101]*t296 - lu[102]*t295);
    const modeler_lanes t298 = lu[14]*(t292 + lu[95]*t297 + lu[96]*t296 + lu[97]*t295);
    const modeler_lanes t299 = lu[13]*(lu[87]*t298 - lu[88]*t297 - lu[89]*t296 - lu[90]*t295);
    const modeler_lanes t300 = lu[12]*(t299 + lu[78]*t298 - lu[79]*t297 - lu[80]*t296 -
    lu[81]*t295);
    const modeler_lanes t301 = (5.0/3.0)*t300;
    const modeler_lanes t302 = (5.0/3.0)*t298;
    const modeler_lanes t303 = (5.0/3.0)*t299;
    const modeler_lanes t304 = t287 + t285*t285 + t289*t289 + t288*t288 + t301*t301 + t302*t302;
    const modeler_lanes t305 = lu[1]*(t298 + lu[23]*t300 + lu[24]*t297 + lu[25]*t296 + lu[26]*t295);
    const modeler_lanes t306 = lu[0]*(t300 - lu[18]*t296 - lu[19]*t295 + lu[20]*t305);
    const modeler_lanes t307 = t304 + t303*t303 + t297*t297 + t296*t296 + t295*t295 + t306*t306;
    const modeler_lanes t308 = lu[3]*(t298 + lu[33]*t300 + lu[34]*t297 + lu[35]*t296 + lu[36]*t295);
    const modeler_lanes t309 = lu[2]*(t300 - lu[28]*t296 - lu[29]*t295 + lu[30]*t308);
    const modeler_lanes t310 = t291 + lu[43]*t300 + t298 + lu[44]*t297 + lu[45]*t296 + lu[46]*t295;
    const modeler_lanes t311 = lu[5]*t310;
    const modeler_lanes t312 = lu[4]*(t290 - t300 + lu[38]*t296 + lu[39]*t295 - lu[40]*t311);
    const modeler_lanes t313 = lu[7]*(t298 + lu[53]*t300 + lu[54]*t297 + lu[55]*t296 + lu[56]*t295);
    const modeler_lanes t314 = lu[6]*(t300 - lu[48]*t296 - lu[49]*t295 + lu[50]*t313);
    const modeler_lanes t315 = t307 + t305*t305 + t309*t309 + t308*t308 + t312*t312 + t311*t311;
    const modeler_lanes t316 = lu[9]*(t298 + lu[63]*t300 + lu[64]*t297 + lu[65]*t296 + lu[66]*t295);
    const modeler_lanes t317 = lu[8]*(t300 - lu[58]*t296 - lu[59]*t295 + lu[60]*t316);
    const modeler_lanes t318 = lu[11]*(t298 + lu[73]*t300 + lu[74]*t297 + lu[75]*t296 +
    lu[76]*t295);
    const modeler_lanes t319 = lu[10]*(t300 - lu[68]*t296 - lu[69]*t295 + lu[70]*t318);
    const modeler_lanes t320 = t315 + t314*t314 + t313*t313 + t317*t317 + t316*t316 + t319*t319;
    const modeler_lanes t321 = J[70] - K[70];
    const modeler_lanes t322 = J[78] - K[78] - lu[51]*t321;
    const modeler_lanes t323 = J[85] - K[85] - lu[52]*t321 - lu[57]*t322;
    const modeler_lanes t324 = lu[103]*t323;
    const modeler_lanes t325 = lu[17]*(lu[104]*t323 - lu[106]*t324);
    const modeler_lanes t326 = lu[16]*(t324 - lu[105]*t325);
    const modeler_lanes t327 = lu[15]*(t323 + lu[101]*t326 + lu[102]*t325);
    const modeler_lanes t328 = lu[14]*(lu[95]*t327 - lu[96]*t326 - lu[97]*t325);
    const modeler_lanes t329 = lu[13]*(lu[87]*t328 - lu[88]*t327 + lu[89]*t326 + lu[90]*t325);
    const modeler_lanes t330 = lu[12]*(t329 + lu[78]*t328 - lu[79]*t327 + lu[80]*t326 +
    lu[81]*t325);
    const modeler_lanes t331 = (5.0/3.0)*t330;
    const modeler_lanes t332 = (5.0/3.0)*t328;
    const modeler_lanes t333 = (5.0/3.0)*t329;
    const modeler_lanes t334 = t320 + t318*t318 + t331*t331 + t332*t332 + t333*t333 + t327*t327;
    const modeler_lanes t335 = lu[1]*(t328 + lu[23]*t330 + lu[24]*t327 - lu[25]*t326 - lu[26]*t325);
    const modeler_lanes t336 = lu[0]*(t330 + lu[18]*t326 + lu[19]*t325 + lu[20]*t335);
    const modeler_lanes t337 = lu[3]*(t328 + lu[33]*t330 + lu[34]*t327 - lu[35]*t326 - lu[36]*t325);
    const modeler_lanes t338 = lu[2]*(t330 + lu[28]*t326 + lu[29]*t325 + lu[30]*t337);
    const modeler_lanes t339 = t334 + t326*t326 + t325*t325 + t336*t336 + t335*t335 + t338*t338;
    const modeler_lanes t340 = lu[5]*(t328 + lu[43]*t330 + lu[44]*t327 - lu[45]*t326 - lu[46]*t325);
    const modeler_lanes t341 = lu[4]*(t330 + lu[38]*t326 + lu[39]*t325 + lu[40]*t340);
    const modeler_lanes t342 = lu[53]*t330 - t322 + t328 + lu[54]*t327 - lu[55]*t326 - lu[56]*t325;
    const modeler_lanes t343 = lu[7]*t342;
    const modeler_lanes t344 = lu[6]*(t321 + t330 + lu[48]*t326 + lu[49]*t325 + lu[50]*t343);
    const modeler_lanes t345 = lu[9]*(t328 + lu[63]*t330 + lu[64]*t327 - lu[65]*t326 - lu[66]*t325);
    const modeler_lanes t346 = lu[8]*(t330 + lu[58]*t326 + lu[59]*t325 + lu[60]*t345);
    const modeler_lanes t347 = t339 + t337*t337 + t341*t341 + t340*t340 + t344*t344 + t343*t343;
    const modeler_lanes t348 = lu[11]*(t328 + lu[73]*t330 + lu[74]*t327 - lu[75]*t326 -
    lu[76]*t325);
    const modeler_lanes t349 = lu[10]*(t330 + lu[68]*t326 + lu[69]*t325 + lu[70]*t348);
    const modeler_lanes t350 = J[71] - K[71];
    const modeler_lanes t351 = J[79] - K[79] - lu[51]*t350;
    const modeler_lanes t352 = J[86] - K[86] - lu[52]*t350 - lu[57]*t351;
    const modeler_lanes t353 = lu[103]*t352;
    const modeler_lanes t354 = lu[17]*(lu[104]*t352 - lu[106]*t353);
    const modeler_lanes t355 = lu[16]*(t353 - lu[105]*t354);
    const modeler_lanes t356 = lu[15]*(t352 + lu[101]*t355 + lu[102]*t354);
    const modeler_lanes t357 = lu[14]*(lu[95]*t356 - lu[96]*t355 - lu[97]*t354);
    const modeler_lanes t358 = lu[13]*(lu[87]*t357 - lu[88]*t356 + lu[89]*t355 + lu[90]*t354);
    const modeler_lanes t359 = lu[12]*(t358 + lu[78]*t357 - lu[79]*t356 + lu[80]*t355 +
    lu[81]*t354);
    const modeler_lanes t360 = (5.0/3.0)*t359;
    const modeler_lanes t361 = (5.0/3.0)*t357;
    const modeler_lanes t362 = t347 + t346*t346 + t345*t345 + t349*t349 + t348*t348 + t360*t360;
    const modeler_lanes t363 = (5.0/3.0)*t358;
    const modeler_lanes t364 = lu[1]*(t357 + lu[23]*t359 + lu[24]*t356 - lu[25]*t355 - lu[26]*t354);
    const modeler_lanes t365 = lu[0]*(t359 + lu[18]*t355 + lu[19]*t354 + lu[20]*t364);
    const modeler_lanes t366 = t362 + t361*t361 + t363*t363 + t356*t356 + t355*t355 + t354*t354;
    const modeler_lanes t367 = lu[3]*(t357 + lu[33]*t359 + lu[34]*t356 - lu[35]*t355 - lu[36]*t354);
    const modeler_lanes t368 = lu[2]*(t359 + lu[28]*t355 + lu[29]*t354 + lu[30]*t367);
    const modeler_lanes t369 = lu[5]*(t357 + lu[43]*t359 + lu[44]*t356 - lu[45]*t355 - lu[46]*t354);
    const modeler_lanes t370 = lu[4]*(t359 + lu[38]*t355 + lu[39]*t354 + lu[40]*t369);
    const modeler_lanes t371 = t366 + t365*t365 + t364*t364 + t368*t368 + t367*t367 + t370*t370;
    const modeler_lanes t372 = lu[53]*t359 - t351 + t357 + lu[54]*t356 - lu[55]*t355 - lu[56]*t354;
    const modeler_lanes t373 = lu[7]*t372;
    const modeler_lanes t374 = lu[6]*(t350 + t359 + lu[48]*t355 + lu[49]*t354 + lu[50]*t373);
    const modeler_lanes t375 = lu[9]*(t357 + lu[63]*t359 + lu[64]*t356 - lu[65]*t355 - lu[66]*t354);
    const modeler_lanes t376 = lu[8]*(t359 + lu[58]*t355 + lu[59]*t354 + lu[60]*t375);
    const modeler_lanes t377 = lu[11]*(t357 + lu[73]*t359 + lu[74]*t356 - lu[75]*t355 -
    lu[76]*t354);
    const modeler_lanes t378 = lu[10]*(t359 + lu[68]*t355 + lu[69]*t354 + lu[70]*t377);
    const modeler_lanes t379 = t371 + t369*t369 + t374*t374 + t373*t373 + t376*t376 + t375*t375;
    const modeler_lanes t380 = J[92] - K[92];
    const modeler_lanes t381 = J[100] - K[100] - lu[61]*t380;
    const modeler_lanes t382 = J[107] - K[107] - lu[62]*t380 - lu[67]*t381;
    const modeler_lanes t383 = lu[106]*t382*lu[17];
    const modeler_lanes t384 = lu[16]*(t382 + lu[105]*t383);
    const modeler_lanes t385 = lu[15]*(lu[101]*t384 - lu[102]*t383);
    const modeler_lanes t386 = lu[14]*(lu[95]*t385 - lu[96]*t384 + lu[97]*t383);
    const modeler_lanes t387 = lu[13]*(lu[87]*t386 - lu[88]*t385 + lu[89]*t384 - lu[90]*t383);
    const modeler_lanes t388 = lu[12]*(t387 + lu[78]*t386 - lu[79]*t385 + lu[80]*t384 -
    lu[81]*t383);
    const modeler_lanes t389 = (5.0/3.0)*t388;
    const modeler_lanes t390 = (5.0/3.0)*t386;
    const modeler_lanes t391 = (5.0/3.0)*t387;
    const modeler_lanes t392 = t379 + t378*t378 + t377*t377 + t389*t389 + t390*t390 + t391*t391;
    const modeler_lanes t393 = lu[1]*(t386 + lu[23]*t388 + lu[24]*t385 - lu[25]*t384 + lu[26]*t383);
    const modeler_lanes t394 = lu[0]*(t388 + lu[18]*t384 - lu[19]*t383 + lu[20]*t393);
    const modeler_lanes t395 = lu[3]*(t386 + lu[33]*t388 + lu[34]*t385 - lu[35]*t384 + lu[36]*t383);
    const modeler_lanes t396 = lu[2]*(t388 + lu[28]*t384 - lu[29]*t383 + lu[30]*t395);
    const modeler_lanes t397 = t392 + t385*t385 + t384*t384 + t383*t383 + t394*t394 + t393*t393;
    const modeler_lanes t398 = lu[5]*(t386 + lu[43]*t388 + lu[44]*t385 - lu[45]*t384 + lu[46]*t383);
    const modeler_lanes t399 = lu[4]*(t388 + lu[38]*t384 - lu[39]*t383 + lu[40]*t398);
    const modeler_lanes t400 = lu[7]*(t386 + lu[53]*t388 + lu[54]*t385 - lu[55]*t384 + lu[56]*t383);
    const modeler_lanes t401 = lu[6]*(t388 + lu[48]*t384 - lu[49]*t383 + lu[50]*t400);
    const modeler_lanes t402 = t397 + t396*t396 + t395*t395 + t399*t399 + t398*t398 + t401*t401;
    const modeler_lanes t403 = t381 + lu[63]*t388 + t386 + lu[64]*t385 - lu[65]*t384 + lu[66]*t383;
    const modeler_lanes t404 = lu[9]*t403;
    const modeler_lanes t405 = lu[8]*(t380 - t388 - lu[58]*t384 + lu[59]*t383 - lu[60]*t404);
    const modeler_lanes t406 = lu[11]*(t386 + lu[73]*t388 + lu[74]*t385 - lu[75]*t384 +
    lu[76]*t383);
    const modeler_lanes t407 = lu[10]*(t388 + lu[68]*t384 - lu[69]*t383 + lu[70]*t406);
    const modeler_lanes t408 = J[93] - K[93];
    const modeler_lanes t409 = J[101] - K[101] - lu[61]*t408;
    const modeler_lanes t410 = J[108] - K[108] - lu[62]*t408 - lu[67]*t409;
    const modeler_lanes t411 = lu[106]*t410*lu[17];
    const modeler_lanes t412 = lu[16]*(t410 + lu[105]*t411);
    const modeler_lanes t413 = lu[15]*(lu[101]*t412 - lu[102]*t411);
    const modeler_lanes t414 = lu[14]*(lu[95]*t413 - lu[96]*t412 + lu[97]*t411);
    const modeler_lanes t415 = lu[13]*(lu[87]*t414 - lu[88]*t413 + lu[89]*t412 - lu[90]*t411);
    const modeler_lanes t416 = lu[12]*(t415 + lu[78]*t414 - lu[79]*t413 + lu[80]*t412 -
    lu[81]*t411);
    const modeler_lanes t417 = (5.0/3.0)*t416;
    const modeler_lanes t418 = t402 + t400*t400 + t405*t405 + t404*t404 + t407*t407 + t406*t406;
    const modeler_lanes t419 = (5.0/3.0)*t414;
    const modeler_lanes t420 = (5.0/3.0)*t415;
    const modeler_lanes t421 = t418 + t417*t417 + t419*t419 + t420*t420 + t413*t413 + t412*t412;
    const modeler_lanes t422 = lu[1]*(t414 + lu[23]*t416 + lu[24]*t413 - lu[25]*t412 + lu[26]*t411);
    const modeler_lanes t423 = lu[0]*(t416 + lu[18]*t412 - lu[19]*t411 + lu[20]*t422);
    const modeler_lanes t424 = lu[3]*(t414 + lu[33]*t416 + lu[34]*t413 - lu[35]*t412 + lu[36]*t411);
    const modeler_lanes t425 = lu[2]*(t416 + lu[28]*t412 - lu[29]*t411 + lu[30]*t424);
    const modeler_lanes t426 = lu[5]*(t414 + lu[43]*t416 + lu[44]*t413 - lu[45]*t412 + lu[46]*t411);
    const modeler_lanes t427 = lu[4]*(t416 + lu[38]*t412 - lu[39]*t411 + lu[40]*t426);
    const modeler_lanes t428 = t421 + t411*t411 + t423*t423 + t422*t422 + t425*t425 + t424*t424;
    const modeler_lanes t429 = lu[7]*(t414 + lu[53]*t416 + lu[54]*t413 - lu[55]*t412 + lu[56]*t411);
    const modeler_lanes t430 = lu[6]*(t416 + lu[48]*t412 - lu[49]*t411 + lu[50]*t429);
    const modeler_lanes t431 = t409 + lu[63]*t416 + t414 + lu[64]*t413 - lu[65]*t412 + lu[66]*t411;
    const modeler_lanes t432 = lu[9]*t431;
    const modeler_lanes t433 = lu[8]*(t408 - t416 - lu[58]*t412 + lu[59]*t411 - lu[60]*t432);
    const modeler_lanes t434 = t428 + t427*t427 + t426*t426 + t430*t430 + t429*t429 + t433*t433;
    const modeler_lanes t435 = lu[11]*(t414 + lu[73]*t416 + lu[74]*t413 - lu[75]*t412 +
    lu[76]*t411);
    const modeler_lanes t436 = lu[10]*(t416 + lu[68]*t412 - lu[69]*t411 + lu[70]*t435);
    const modeler_lanes t437 = J[114] - K[114];
    const modeler_lanes t438 = J[122] - K[122] - lu[71]*t437;
    const modeler_lanes t439 = lu[17]*(J[129] - K[129] - lu[72]*t437 - lu[77]*t438);
    const modeler_lanes t440 = lu[105]*t439*lu[16];
    const modeler_lanes t441 = lu[15]*(lu[101]*t440 - lu[102]*t439);
    const modeler_lanes t442 = lu[14]*(lu[95]*t441 - lu[96]*t440 + lu[97]*t439);
    const modeler_lanes t443 = lu[13]*(lu[87]*t442 - lu[88]*t441 + lu[89]*t440 - lu[90]*t439);
    const modeler_lanes t444 = lu[12]*(t443 + lu[78]*t442 - lu[79]*t441 + lu[80]*t440 -
    lu[81]*t439);
    const modeler_lanes t445 = (5.0/3.0)*t444;
    const modeler_lanes t446 = (5.0/3.0)*t442;
    const modeler_lanes t447 = (5.0/3.0)*t443;
    const modeler_lanes t448 = t434 + t432*t432 + t436*t436 + t435*t435 + t445*t445 + t446*t446;
    const modeler_lanes t449 = lu[1]*(t442 + lu[23]*t444 + lu[24]*t441 - lu[25]*t440 + lu[26]*t439);
    const modeler_lanes t450 = lu[0]*(t444 + lu[18]*t440 - lu[19]*t439 + lu[20]*t449);
    const modeler_lanes t451 = t448 + t447*t447 + t441*t441 + t440*t440 + t439*t439 + t450*t450;
    const modeler_lanes t452 = lu[3]*(t442 + lu[33]*t444 + lu[34]*t441 - lu[35]*t440 + lu[36]*t439);
    const modeler_lanes t453 = lu[2]*(t444 + lu[28]*t440 - lu[29]*t439 + lu[30]*t452);
    const modeler_lanes t454 = lu[5]*(t442 + lu[43]*t444 + lu[44]*t441 - lu[45]*t440 + lu[46]*t439);
    const modeler_lanes t455 = lu[4]*(t444 + lu[38]*t440 - lu[39]*t439 + lu[40]*t454);
    const modeler_lanes t456 = lu[7]*(t442 + lu[53]*t444 + lu[54]*t441 - lu[55]*t440 + lu[56]*t439);
    const modeler_lanes t457 = lu[6]*(t444 + lu[48]*t440 - lu[49]*t439 + lu[50]*t456);
    const modeler_lanes t458 = t451 + t449*t449 + t453*t453 + t452*t452 + t455*t455 + t454*t454;
    const modeler_lanes t459 = lu[9]*(t442 + lu[63]*t444 + lu[64]*t441 - lu[65]*t440 + lu[66]*t439);
    const modeler_lanes t460 = lu[8]*(t444 + lu[58]*t440 - lu[59]*t439 + lu[60]*t459);
    const modeler_lanes t461 = lu[73]*t444 - t438 + t442 + lu[74]*t441 - lu[75]*t440 + lu[76]*t439;
    const modeler_lanes t462 = lu[11]*t461;
    const modeler_lanes t463 = lu[10]*(t437 + t444 + lu[68]*t440 - lu[69]*t439 + lu[70]*t462);
    const modeler_lanes t464 = t458 + t457*t457 + t456*t456 + t460*t460 + t459*t459 + t463*t463;
    const modeler_lanes t465 = J[115] - K[115];
    const modeler_lanes t466 = J[123] - K[123] - lu[71]*t465;
    const modeler_lanes t467 = lu[17]*(J[130] - K[130] - lu[72]*t465 - lu[77]*t466);
    const modeler_lanes t468 = lu[105]*t467*lu[16];
    const modeler_lanes t469 = lu[15]*(lu[101]*t468 - lu[102]*t467);
    const modeler_lanes t470 = lu[14]*(lu[95]*t469 - lu[96]*t468 + lu[97]*t467);
    const modeler_lanes t471 = lu[13]*(lu[87]*t470 - lu[88]*t469 + lu[89]*t468 - lu[90]*t467);
    const modeler_lanes t472 = lu[12]*(t471 + lu[78]*t470 - lu[79]*t469 + lu[80]*t468 -
    lu[81]*t467);
    const modeler_lanes t473 = (5.0/3.0)*t472;
    const modeler_lanes t474 = (5.0/3.0)*t470;
    const modeler_lanes t475 = (5.0/3.0)*t471;
    const modeler_lanes t476 = t464 + t462*t462 + t473*t473 + t474*t474 + t475*t475 + t469*t469;
    const modeler_lanes t477 = lu[1]*(t470 + lu[23]*t472 + lu[24]*t469 - lu[25]*t468 + lu[26]*t467);
    const modeler_lanes t478 = lu[0]*(t472 + lu[18]*t468 - lu[19]*t467 + lu[20]*t477);
    const modeler_lanes t479 = lu[3]*(t470 + lu[33]*t472 + lu[34]*t469 - lu[35]*t468 + lu[36]*t467);
    const modeler_lanes t480 = lu[2]*(t472 + lu[28]*t468 - lu[29]*t467 + lu[30]*t479);
    const modeler_lanes t481 = t476 + t468*t468 + t467*t467 + t478*t478 + t477*t477 + t480*t480;
    const modeler_lanes t482 = lu[5]*(t470 + lu[43]*t472 + lu[44]*t469 - lu[45]*t468 + lu[46]*t467);
    const modeler_lanes t483 = lu[4]*(t472 + lu[38]*t468 - lu[39]*t467 + lu[40]*t482);
    const modeler_lanes t484 = lu[7]*(t470 + lu[53]*t472 + lu[54]*t469 - lu[55]*t468 + lu[56]*t467);
    const modeler_lanes t485 = lu[6]*(t472 + lu[48]*t468 - lu[49]*t467 + lu[50]*t484);
    const modeler_lanes t486 = lu[9]*(t470 + lu[63]*t472 + lu[64]*t469 - lu[65]*t468 + lu[66]*t467);
    const modeler_lanes t487 = lu[8]*(t472 + lu[58]*t468 - lu[59]*t467 + lu[60]*t486);
    const modeler_lanes t488 = t481 + t479*t479 + t483*t483 + t482*t482 + t485*t485 + t484*t484;
    const modeler_lanes t489 = lu[73]*t472 - t466 + t470 + lu[74]*t469 - lu[75]*t468 + lu[76]*t467;
    const modeler_lanes t490 = lu[11]*t489;
    const modeler_lanes t491 = lu[10]*(t465 + t472 + lu[68]*t468 - lu[69]*t467 + lu[70]*t490);
    x[0] = t488 + t487*t487 + t486*t486 + t491*t491 + t490*t490;
}

MODELER_TARGET static void MODELER_VERSION(rows)(
const modeler_lanes *q, const modeler_lanes *t, const modeler_lanes *G, const modeler_lanes *lu, const modeler_lanes *v, const modeler_lanes *a, double *values)
{
    const double x_B1_x = cos(evra_geo_beta1);
    const double x_B1_y = sin(evra_geo_beta1);
    const double p41_x = cos(evra_geo_phi1)*evra_geo_RP;
    const double p41_y = sin(evra_geo_phi1)*evra_geo_RP;
    const double x_B2_x = cos(evra_geo_beta2);
    const double x_B2_y = sin(evra_geo_beta2);
    const double p42_x = evra_geo_RP*cos(evra_geo_phi2);
    const double p42_y = evra_geo_RP*sin(evra_geo_phi2);
    const double x_B3_x = cos(evra_geo_beta3);
    const double x_B3_y = sin(evra_geo_beta3);
    const double p43_x = evra_geo_RP*cos(evra_geo_phi3);
    const double p43_y = evra_geo_RP*sin(evra_geo_phi3);
    const double x_B4_x = cos(evra_geo_beta4);
    const double x_B4_y = sin(evra_geo_beta4);
    const double p44_x = evra_geo_RP*cos(evra_geo_phi4);
    const double p44_y = evra_geo_RP*sin(evra_geo_phi4);
    const double x_B5_x = cos(evra_geo_beta5);
    const double x_B5_y = sin(evra_geo_beta5);
    const double p45_x = evra_geo_RP*cos(evra_geo_phi5);
    const double p45_y = evra_geo_RP*sin(evra_geo_phi5);
    const double x_B6_x = cos(evra_geo_beta6);
    const double x_B6_y = sin(evra_geo_beta6);
    const double p46_x = evra_geo_RP*cos(evra_geo_phi6);
    const double p46_y = evra_geo_RP*sin(evra_geo_phi6);
    const modeler_lanes t1 = t[2]*t[4];
    const modeler_lanes t2 = G[3]*v[0] + G[21]*v[1] + G[39]*v[2] + G[57]*v[3] + G[75]*v[4] +
    G[93]*v[5];
    const modeler_lanes t3 = t2 + G[111]*v[6] + G[129]*v[7];
    const modeler_lanes t4 = t[1]*t[3];
    const modeler_lanes t5 = G[5]*v[0] + G[23]*v[1] + G[41]*v[2] + G[59]*v[3] + G[77]*v[4] +
    G[95]*v[5];
    const modeler_lanes t6 = t5 + G[113]*v[6] + G[131]*v[7];
    const modeler_lanes t7 = t[5]*t6;
    const modeler_lanes t8 = t[0]*t3;
    const modeler_lanes t9 = G[4]*v[0] + G[22]*v[1] + G[40]*v[2] + G[58]*v[3] + G[76]*v[4] +
    G[94]*v[5];
    const modeler_lanes t10 = t9 + G[112]*v[6] + G[130]*v[7];
    const modeler_lanes t11 = t[2]*t10;
    const modeler_lanes t12 = t[3]*t8 + t[1]*t11;
    const modeler_lanes t13 = t[1]*t3;
    const modeler_lanes t14 = t[4]*t6;
    const modeler_lanes t15 = t4*t7 - t[4]*t12 + (t[5]*t13 - t[0]*t14);
    const modeler_lanes t16 = t[4]*t13 + t[0]*t7 + (t4*t14 + t[5]*t12);
    const modeler_lanes t17 = t[0]*t[2];
    const modeler_lanes t18 = t[3]*t10;
    const modeler_lanes t19 = t[2]*t13 + t[0]*t18;
    const modeler_lanes t20 = t17*t7 + t[4]*t19;
    const modeler_lanes t21 = t17*t14 - t[5]*t19;
    const modeler_lanes t22 = t[0]*t[3];
    const modeler_lanes t23 = t[3]*t13 - t[0]*t11;
    const modeler_lanes t24 = t[4]*t8 - t[1]*t7 + (t22*t14 - t[5]*t23);
    const modeler_lanes t25 = t22*t7 + t[4]*t23 + (t[5]*t8 + t[1]*t14);
    const modeler_lanes t26 = G[12]*v[0] + G[30]*v[1] + G[48]*v[2] + G[66]*v[3] + G[84]*v[4];
    const modeler_lanes t27 = t26 + G[102]*v[5] + G[120]*v[6] + G[138]*v[7];
    const modeler_lanes t28 = t[18]*t27;
    const modeler_lanes t29 = G[13]*v[0] + G[31]*v[1] + G[49]*v[2] + G[67]*v[3] + G[85]*v[4];
    const modeler_lanes t30 = t29 + G[103]*v[5] + G[121]*v[6] + G[139]*v[7];
    const modeler_lanes t31 = t[21]*t30;
    const modeler_lanes t32 = t3*(p44_x*t15 + p44_y*t16) - t10*(p44_x*t20 + p44_y*t21) -
    t6*(p44_x*t24 - p44_y*t25);
    const modeler_lanes t33 = t[19]*t27;
    const modeler_lanes t34 = t[20]*t30;
    const modeler_lanes t35 = t32 + t27*(t[19]*t[20]*v[5] + q[19]*(t[20]*t28 - t[19]*t31));
    const modeler_lanes t36 = t35 + t30*(t[18]*t[21]*v[5] - q[19]*(t[21]*t33 - t[18]*t34));
    const modeler_lanes t37 = t[4]*t11 - t[3]*t7;
    const modeler_lanes t38 = t[5]*t11 + t[3]*t14;
    const modeler_lanes t39 = t[5]*t18 - t[2]*t14;
    const modeler_lanes t40 = t[4]*t18 + t[2]*t7;
    const modeler_lanes t41 = x_B4_x*t[18];
    const modeler_lanes t42 = t27*(t[20]*t41*v[5] - q[19]*(t41*t31 + x_B4_x*t33*t[20]));
    const modeler_lanes t43 = x_B4_x*t[19];
    const modeler_lanes t44 = t[21]*t43 - x_B4_y*t[20];
    const modeler_lanes t45 = x_B4_x*t28;
    const modeler_lanes t46 = t10*(p44_x*t37 - p44_y*t38) - t6*(p44_x*t39 + p44_y*t40) - t42;
    const modeler_lanes t47 = t46 + t30*(v[5]*t44 + q[19]*(t43*t34 + t[21]*t45 + x_B4_y*t31));
    const modeler_lanes t48 = t47 - v[5]*(t[20]*t45 - t43*t31 + x_B4_y*t34);
    const modeler_lanes t49 = t[1]*t[2];
    const modeler_lanes t50 = t[2]*t8 - t[1]*t18;
    const modeler_lanes t51 = t49*t7 - t[4]*t50;
    const modeler_lanes t52 = t49*t14 + t[5]*t50;
    const modeler_lanes t53 = x_B4_y*t[18];
    const modeler_lanes t54 = t3*(p44_x*t25 + p44_y*t24) + t10*(p44_x*t51 + p44_y*t52) +
    t6*(p44_x*t16 - p44_y*t15);
    const modeler_lanes t55 = x_B4_y*t[19];
    const modeler_lanes t56 = t[21]*t55 + x_B4_x*t[20];
    const modeler_lanes t57 = x_B4_y*t28;
    const modeler_lanes t58 = t54 - t27*(t[20]*t53*v[5] - q[19]*(t53*t31 + x_B4_y*t33*t[20]));
    const modeler_lanes t59 = t58 + t30*(v[5]*t56 + q[19]*(t55*t34 + t[21]*t57 - x_B4_x*t31));
    const modeler_lanes t60 = t59 + v[5]*(t55*t31 - t[20]*t57 + x_B4_x*t34) - lu[51]*t48;
    const modeler_lanes t61 = G[6]*v[0] + G[24]*v[1] + G[42]*v[2] + G[60]*v[3] + G[78]*v[4] +
    G[96]*v[5];
    const modeler_lanes t62 = t61 + G[114]*v[6] + G[132]*v[7];
    const modeler_lanes t63 = t[6]*t62;
    const modeler_lanes t64 = G[7]*v[0] + G[25]*v[1] + G[43]*v[2] + G[61]*v[3] + G[79]*v[4] +
    G[97]*v[5];
    const modeler_lanes t65 = t64 + G[115]*v[6] + G[133]*v[7];
    const modeler_lanes t66 = t[9]*t65;
    const modeler_lanes t67 = t3*(p41_x*t15 + p41_y*t16) - t10*(p41_x*t20 + p41_y*t21) -
    t6*(p41_x*t24 - p41_y*t25);
    const modeler_lanes t68 = t[7]*t62;
    const modeler_lanes t69 = t[8]*t65;
    const modeler_lanes t70 = t67 + t62*(t[7]*t[8]*v[2] + q[10]*(t[8]*t63 - t[7]*t66));
    const modeler_lanes t71 = t70 + t65*(t[6]*t[9]*v[2] - q[10]*(t[9]*t68 - t[6]*t69));
    const modeler_lanes t72 = x_B1_x*t[6];
    const modeler_lanes t73 = t62*(t[8]*t72*v[2] - q[10]*(t72*t66 + x_B1_x*t68*t[8]));
    const modeler_lanes t74 = x_B1_x*t[7];
    const modeler_lanes t75 = t[9]*t74 - x_B1_y*t[8];
    const modeler_lanes t76 = x_B1_x*t63;
    const modeler_lanes t77 = t65*(v[2]*t75 + q[10]*(t74*t69 + t[9]*t76 + x_B1_y*t66));
    const modeler_lanes t78 = t10*(p41_x*t37 - p41_y*t38) - t6*(p41_x*t39 + p41_y*t40) - t73 + t77;
    const modeler_lanes t79 = t78 - v[2]*(t[8]*t76 - t74*t66 + x_B1_y*t69);
    const modeler_lanes t80 = x_B1_y*t[6];
    const modeler_lanes t81 = t3*(p41_x*t25 + p41_y*t24) + t10*(p41_x*t51 + p41_y*t52) +
    t6*(p41_x*t16 - p41_y*t15);
    const modeler_lanes t82 = x_B1_y*t[7];
    const modeler_lanes t83 = t[9]*t82 + x_B1_x*t[8];
    const modeler_lanes t84 = x_B1_y*t63;
    const modeler_lanes t85 = t81 - t62*(t[8]*t80*v[2] - q[10]*(t80*t66 + x_B1_y*t68*t[8]));
    const modeler_lanes t86 = t85 + t65*(v[2]*t83 + q[10]*(t82*t69 + t[9]*t84 - x_B1_x*t66));
    const modeler_lanes t87 = t86 + v[2]*(t82*t66 - t[8]*t84 + x_B1_x*t69) - lu[21]*t79;
    const modeler_lanes t88 = t71 + v[2]*(t[8]*t68 + t[6]*t66) - lu[22]*t79 - lu[27]*t87;
    const modeler_lanes t89 = G[8]*v[0] + G[26]*v[1] + G[44]*v[2] + G[62]*v[3] + G[80]*v[4] +
    G[98]*v[5];
    const modeler_lanes t90 = t89 + G[116]*v[6] + G[134]*v[7];
    const modeler_lanes t91 = t[10]*t90;
    const modeler_lanes t92 = G[9]*v[0] + G[27]*v[1] + G[45]*v[2] + G[63]*v[3] + G[81]*v[4] +
    G[99]*v[5];
    const modeler_lanes t93 = t92 + G[117]*v[6] + G[135]*v[7];
    const modeler_lanes t94 = t[13]*t93;
    const modeler_lanes t95 = t3*(p42_x*t15 + p42_y*t16) - t10*(p42_x*t20 + p42_y*t21) -
    t6*(p42_x*t24 - p42_y*t25);
    const modeler_lanes t96 = t[11]*t90;
    const modeler_lanes t97 = t[12]*t93;
    const modeler_lanes t98 = t95 + t90*(t[11]*t[12]*v[3] + q[13]*(t[12]*t91 - t[11]*t94));
    const modeler_lanes t99 = t98 + t93*(t[10]*t[13]*v[3] - q[13]*(t[13]*t96 - t[10]*t97));
    const modeler_lanes t100 = x_B2_x*t[10];
    const modeler_lanes t101 = t90*(t[12]*t100*v[3] - q[13]*(t100*t94 + x_B2_x*t96*t[12]));
    const modeler_lanes t102 = x_B2_x*t[11];
    const modeler_lanes t103 = t[13]*t102 - x_B2_y*t[12];
    const modeler_lanes t104 = x_B2_x*t91;
    const modeler_lanes t105 = t93*(v[3]*t103 + q[13]*(t102*t97 + t[13]*t104 + x_B2_y*t94));
    const modeler_lanes t106 = t10*(p42_x*t37 - p42_y*t38) - t6*(p42_x*t39 + p42_y*t40) - t101 +
    t105;
    const modeler_lanes t107 = t106 - v[3]*(t[12]*t104 - t102*t94 + x_B2_y*t97);
    const modeler_lanes t108 = x_B2_y*t[10];
    const modeler_lanes t109 = t3*(p42_x*t25 + p42_y*t24) + t10*(p42_x*t51 + p42_y*t52) +
    t6*(p42_x*t16 - p42_y*t15);
    const modeler_lanes t110 = x_B2_y*t[11];
    const modeler_lanes t111 = t[13]*t110 + x_B2_x*t[12];
    const modeler_lanes t112 = x_B2_y*t91;
    const modeler_lanes t113 = t109 - t90*(t[12]*t108*v[3] - q[13]*(t108*t94 + x_B2_y*t96*t[12]));
    const modeler_lanes t114 = t113 + t93*(v[3]*t111 + q[13]*(t110*t97 + t[13]*t112 - x_B2_x*t94));
    const modeler_lanes t115 = t114 + v[3]*(t110*t94 - t[12]*t112 + x_B2_x*t97) - lu[31]*t107;
    const modeler_lanes t116 = t99 + v[3]*(t[12]*t96 + t[10]*t94) - lu[32]*t107 - lu[37]*t115;
    const modeler_lanes t117 = t116 - lu[82]*t88;
    const modeler_lanes t118 = t36 + v[5]*(t[20]*t33 + t[18]*t31) - lu[52]*t48 - lu[57]*t60 -
    lu[84]*t88;
    const modeler_lanes t119 = G[10]*v[0] + G[28]*v[1] + G[46]*v[2] + G[64]*v[3] + G[82]*v[4];
    const modeler_lanes t120 = t119 + G[100]*v[5] + G[118]*v[6] + G[136]*v[7];
    const modeler_lanes t121 = t[14]*t120;
    const modeler_lanes t122 = G[11]*v[0] + G[29]*v[1] + G[47]*v[2] + G[65]*v[3] + G[83]*v[4];
    const modeler_lanes t123 = t122 + G[101]*v[5] + G[119]*v[6] + G[137]*v[7];
    const modeler_lanes t124 = t[17]*t123;
    const modeler_lanes t125 = t3*(p43_x*t15 + p43_y*t16) - t10*(p43_x*t20 + p43_y*t21) -
    t6*(p43_x*t24 - p43_y*t25);
    const modeler_lanes t126 = t[15]*t120;
    const modeler_lanes t127 = t[16]*t123;
    const modeler_lanes t128 = t125 + t120*(t[15]*t[16]*v[4] + q[16]*(t[16]*t121 - t[15]*t124));
    const modeler_lanes t129 = t128 + t123*(t[14]*t[17]*v[4] - q[16]*(t[17]*t126 - t[14]*t127));
    const modeler_lanes t130 = x_B3_x*t[14];
    const modeler_lanes t131 = t120*(t[16]*t130*v[4] - q[16]*(t130*t124 + x_B3_x*t126*t[16]));
    const modeler_lanes t132 = x_B3_x*t[15];
    const modeler_lanes t133 = t[17]*t132 - x_B3_y*t[16];
    const modeler_lanes t134 = x_B3_x*t121;
    const modeler_lanes t135 = t123*(v[4]*t133 + q[16]*(t132*t127 + t[17]*t134 + x_B3_y*t124));
    const modeler_lanes t136 = t10*(p43_x*t37 - p43_y*t38) - t6*(p43_x*t39 + p43_y*t40) - t131 +
    t135;
    const modeler_lanes t137 = t136 - v[4]*(t[16]*t134 - t132*t124 + x_B3_y*t127);
    const modeler_lanes t138 = x_B3_y*t[14];
    const modeler_lanes t139 = t3*(p43_x*t25 + p43_y*t24) + t10*(p43_x*t51 + p43_y*t52) +
    t6*(p43_x*t16 - p43_y*t15);
    const modeler_lanes t140 = x_B3_y*t[15];
    const modeler_lanes t141 = t[17]*t140 + x_B3_x*t[16];
    const modeler_lanes t142 = x_B3_y*t121;
    const modeler_lanes t143 = t139 - t120*(t[16]*t138*v[4] - q[16]*(t138*t124 +
    x_B3_y*t126*t[16]));
    const modeler_lanes t144 = t143 + t123*(v[4]*t141 + q[16]*(t140*t127 + t[17]*t142 -
    x_B3_x*t124));
    const modeler_lanes t145 = t144 + v[4]*(t140*t124 - t[16]*t142 + x_B3_x*t127) - lu[41]*t137;
    const modeler_lanes t146 = t129 + v[4]*(t[16]*t126 + t[14]*t124) - lu[42]*t137 - lu[47]*t145;
    const modeler_lanes t147 = t146 - lu[83]*t88 - lu[91]*t117;
    const modeler_lanes t148 = t118 - lu[92]*t117 - lu[98]*t147;
    const modeler_lanes t149 = G[14]*v[0] + G[32]*v[1] + G[50]*v[2] + G[68]*v[3] + G[86]*v[4];
    const modeler_lanes t150 = t149 + G[104]*v[5] + G[122]*v[6] + G[140]*v[7];
    const modeler_lanes t151 = t[22]*t150;
    const modeler_lanes t152 = G[15]*v[0] + G[33]*v[1] + G[51]*v[2] + G[69]*v[3] + G[87]*v[4];
    const modeler_lanes t153 = t152 + G[105]*v[5] + G[123]*v[6] + G[141]*v[7];
    const modeler_lanes t154 = t[25]*t153;
    const modeler_lanes t155 = t3*(p45_x*t15 + p45_y*t16) - t10*(p45_x*t20 + p45_y*t21) -
    t6*(p45_x*t24 - p45_y*t25);
    const modeler_lanes t156 = t[23]*t150;
    const modeler_lanes t157 = t[24]*t153;
    const modeler_lanes t158 = t155 + t150*(t[23]*t[24]*v[6] + q[22]*(t[24]*t151 - t[23]*t154));
    const modeler_lanes t159 = t158 + t153*(t[22]*t[25]*v[6] - q[22]*(t[25]*t156 - t[22]*t157));
    const modeler_lanes t160 = x_B5_x*t[22];
    const modeler_lanes t161 = t150*(t[24]*t160*v[6] - q[22]*(t160*t154 + x_B5_x*t156*t[24]));
    const modeler_lanes t162 = x_B5_x*t[23];
    const modeler_lanes t163 = t[25]*t162 - x_B5_y*t[24];
    const modeler_lanes t164 = x_B5_x*t151;
    const modeler_lanes t165 = t153*(v[6]*t163 + q[22]*(t162*t157 + t[25]*t164 + x_B5_y*t154));
    const modeler_lanes t166 = t10*(p45_x*t37 - p45_y*t38) - t6*(p45_x*t39 + p45_y*t40) - t161 +
    t165;
    const modeler_lanes t167 = t166 - v[6]*(t[24]*t164 - t162*t154 + x_B5_y*t157);
    const modeler_lanes t168 = x_B5_y*t[22];
    const modeler_lanes t169 = t3*(p45_x*t25 + p45_y*t24) + t10*(p45_x*t51 + p45_y*t52) +
    t6*(p45_x*t16 - p45_y*t15);
    const modeler_lanes t170 = x_B5_y*t[23];
    const modeler_lanes t171 = t[25]*t170 + x_B5_x*t[24];
    const modeler_lanes t172 = x_B5_y*t151;
    const modeler_lanes t173 = t169 - t150*(t[24]*t168*v[6] - q[22]*(t168*t154 +
    x_B5_y*t156*t[24]));
    const modeler_lanes t174 = t173 + t153*(v[6]*t171 + q[22]*(t170*t157 + t[25]*t172 -
    x_B5_x*t154));
    const modeler_lanes t175 = t174 + v[6]*(t170*t154 - t[24]*t172 + x_B5_x*t157) - lu[61]*t167;
    const modeler_lanes t176 = t159 + v[6]*(t[24]*t156 + t[22]*t154) - lu[62]*t167 - lu[67]*t175;
    const modeler_lanes t177 = t176 - lu[85]*t88 - lu[93]*t117 - lu[99]*t147 - lu[103]*t148;
    const modeler_lanes t178 = G[16]*v[0] + G[34]*v[1] + G[52]*v[2] + G[70]*v[3] + G[88]*v[4];
    const modeler_lanes t179 = t178 + G[106]*v[5] + G[124]*v[6] + G[142]*v[7];
    const modeler_lanes t180 = t[26]*t179;
    const modeler_lanes t181 = G[17]*v[0] + G[35]*v[1] + G[53]*v[2] + G[71]*v[3] + G[89]*v[4];
    const modeler_lanes t182 = t181 + G[107]*v[5] + G[125]*v[6] + G[143]*v[7];
    const modeler_lanes t183 = t[29]*t182;
    const modeler_lanes t184 = t3*(p46_x*t15 + p46_y*t16) - t10*(p46_x*t20 + p46_y*t21) -
    t6*(p46_x*t24 - p46_y*t25);
    const modeler_lanes t185 = t[27]*t179;
    const modeler_lanes t186 = t[28]*t182;
    const modeler_lanes t187 = t184 + t179*(t[27]*t[28]*v[7] + q[25]*(t[28]*t180 - t[27]*t183));
    const modeler_lanes t188 = t187 + t182*(t[26]*t[29]*v[7] - q[25]*(t[29]*t185 - t[26]*t186));
    const modeler_lanes t189 = x_B6_x*t[26];
    const modeler_lanes t190 = t179*(t[28]*t189*v[7] - q[25]*(t189*t183 + x_B6_x*t185*t[28]));
    const modeler_lanes t191 = x_B6_x*t[27];
    const modeler_lanes t192 = t[29]*t191 - x_B6_y*t[28];
    const modeler_lanes t193 = x_B6_x*t180;
    const modeler_lanes t194 = t182*(v[7]*t192 + q[25]*(t191*t186 + t[29]*t193 + x_B6_y*t183));
    const modeler_lanes t195 = t10*(p46_x*t37 - p46_y*t38) - t6*(p46_x*t39 + p46_y*t40) - t190 +
    t194;
    const modeler_lanes t196 = t195 - v[7]*(t[28]*t193 - t191*t183 + x_B6_y*t186);
    const modeler_lanes t197 = x_B6_y*t[26];
    const modeler_lanes t198 = t3*(p46_x*t25 + p46_y*t24) + t10*(p46_x*t51 + p46_y*t52) +
    t6*(p46_x*t16 - p46_y*t15);
    const modeler_lanes t199 = x_B6_y*t[27];
    const modeler_lanes t200 = t[29]*t199 + x_B6_x*t[28];
    const modeler_lanes t201 = x_B6_y*t180;
    const modeler_lanes t202 = t198 - t179*(t[28]*t197*v[7] - q[25]*(t197*t183 +
    x_B6_y*t185*t[28]));
    const modeler_lanes t203 = t202 + t182*(v[7]*t200 + q[25]*(t199*t186 + t[29]*t201 -
    x_B6_x*t183));
    const modeler_lanes t204 = t203 + v[7]*(t199*t183 - t[28]*t201 + x_B6_x*t186) - lu[71]*t196;
    const modeler_lanes t205 = t188 + v[7]*(t[28]*t185 + t[26]*t183) - lu[72]*t196 - lu[77]*t204;
    const modeler_lanes t206 = t205 - lu[86]*t88 - lu[94]*t117 - lu[100]*t147 - lu[104]*t148;
    const modeler_lanes t207 = lu[17]*(t206 - lu[106]*t177);
    const modeler_lanes t208 = lu[16]*(t177 - lu[105]*t207);
    const modeler_lanes t209 = lu[15]*(t148 - lu[101]*t208 - lu[102]*t207);
    const modeler_lanes t210 = G[3]*a[0] + G[21]*a[1] + G[39]*a[2] + G[57]*a[3] + G[75]*a[4] +
    G[93]*a[5];
    const modeler_lanes t211 = t209 - (t210 + G[111]*a[6] + G[129]*a[7]);
    const modeler_lanes t212 = t[3]*t3;
    const modeler_lanes t213 = t[2]*t211 + t10*t212;
    const modeler_lanes t214 = G[4]*a[0] + G[22]*a[1] + G[40]*a[2] + G[58]*a[3] + G[76]*a[4] +
    G[94]*a[5];
    const modeler_lanes t215 = t208 - (t214 + G[112]*a[6] + G[130]*a[7]);
    const modeler_lanes t216 = t[2]*t3;
    const modeler_lanes t217 = t[4]*t10 - t[5]*t216;
    const modeler_lanes t218 = t[4]*t213 + t[5]*t215 - t6*t217;
    const modeler_lanes t219 = t[2]*t[5];
    const modeler_lanes t220 = t[4]*t216 + t[5]*t10;
    const modeler_lanes t221 = t6 + t212;
    const modeler_lanes t222 = t220*t221;
    const modeler_lanes t223 = t219*t222;
    const modeler_lanes t224 = t220*t217;
    const modeler_lanes t225 = t[3]*t224;
    const modeler_lanes t226 = t1*t218 + t223 + t225;
    const modeler_lanes t227 = t[4]*t222;
    const modeler_lanes t228 = t[5]*t218 - t227;
    const modeler_lanes t229 = G[5]*t224;
    MODELER_PUT(0) = -(G[3]*t226 + G[4]*t228 + t229);
    const modeler_lanes t230 = G[23]*t224;
    MODELER_PUT(90) = -(G[21]*t226 + G[22]*t228 + t230);
    const modeler_lanes t231 = G[41]*t224;
    MODELER_PUT(179) = -(G[39]*t226 + G[40]*t228 + t231);
    const modeler_lanes t232 = G[59]*t224;
    MODELER_PUT(267) = -(G[57]*t226 + G[58]*t228 + t232);
    const modeler_lanes t233 = G[77]*t224;
    MODELER_PUT(355) = -(G[75]*t226 + G[76]*t228 + t233);
    const modeler_lanes t234 = G[95]*t224;
    MODELER_PUT(443) = -(G[93]*t226 + G[94]*t228 + t234);
    const modeler_lanes t235 = G[113]*t224;
    MODELER_PUT(531) = -(G[111]*t226 + G[112]*t228 + t235);
    const modeler_lanes t236 = G[131]*t224;
    MODELER_PUT(619) = -(G[129]*t226 + G[130]*t228 + t236);
    const modeler_lanes t237 = t[4]*t215 - t[5]*t213 + t6*t220;
    const modeler_lanes t238 = t237 + t222;
    const modeler_lanes t239 = t217*t221;
    const modeler_lanes t240 = t218 - t239;
    const modeler_lanes t241 = t221*t221;
    const modeler_lanes t242 = t217*t217 + t241;
    const modeler_lanes t243 = t220*t220 + t241;
    const modeler_lanes t244 = t242 - t243;
    const modeler_lanes t245 = t1*t238 - t219*t240 + t[3]*t244;
    const modeler_lanes t246 = t[5]*t238 + t[4]*t240;
    MODELER_PUT(1) = -(G[3]*t245 + G[4]*t246 + G[5]*t244);
    MODELER_PUT(91) = -(G[21]*t245 + G[22]*t246 + G[23]*t244);
    MODELER_PUT(180) = -(G[39]*t245 + G[40]*t246 + G[41]*t244);
    MODELER_PUT(268) = -(G[57]*t245 + G[58]*t246 + G[59]*t244);
    MODELER_PUT(356) = -(G[75]*t245 + G[76]*t246 + G[77]*t244);
    MODELER_PUT(444) = -(G[93]*t245 + G[94]*t246 + G[95]*t244);
    MODELER_PUT(532) = -(G[111]*t245 + G[112]*t246 + G[113]*t244);
    MODELER_PUT(620) = -(G[129]*t245 + G[130]*t246 + G[131]*t244);
    const modeler_lanes t247 = G[5]*a[0] + G[23]*a[1] + G[41]*a[2] + G[59]*a[3] + G[77]*a[4] +
    G[95]*a[5];
    const modeler_lanes t248 = t207 - (t247 + G[113]*a[6] + G[131]*a[7]) + (t[3]*t211 - t10*t216);
    const modeler_lanes t249 = t248 - t224;
    const modeler_lanes t250 = t216*t216 + t10*t10;
    const modeler_lanes t251 = t250 - t242;
    const modeler_lanes t252 = t218 + t239;
    const modeler_lanes t253 = t1*t249 - t219*t251 + t[3]*t252;
    const modeler_lanes t254 = t[5]*t249 + t[4]*t251;
    MODELER_PUT(2) = -(G[3]*t253 + G[4]*t254 + G[5]*t252);
    MODELER_PUT(92) = -(G[21]*t253 + G[22]*t254 + G[23]*t252);
    MODELER_PUT(181) = -(G[39]*t253 + G[40]*t254 + G[41]*t252);
    MODELER_PUT(269) = -(G[57]*t253 + G[58]*t254 + G[59]*t252);
    MODELER_PUT(357) = -(G[75]*t253 + G[76]*t254 + G[77]*t252);
    MODELER_PUT(445) = -(G[93]*t253 + G[94]*t254 + G[95]*t252);
    MODELER_PUT(533) = -(G[111]*t253 + G[112]*t254 + G[113]*t252);
    MODELER_PUT(621) = -(G[129]*t253 + G[130]*t254 + G[131]*t252);
    const modeler_lanes t255 = t1*t239;
    const modeler_lanes t256 = t219*t237 - t255 + t225;
    const modeler_lanes t257 = t[5]*t239;
    const modeler_lanes t258 = t257 + t[4]*t237;
    MODELER_PUT(3) = G[3]*t256 - G[4]*t258 + t229;
    MODELER_PUT(93) = G[21]*t256 - G[22]*t258 + t230;
    MODELER_PUT(182) = G[39]*t256 - G[40]*t258 + t231;
    MODELER_PUT(270) = G[57]*t256 - G[58]*t258 + t232;
    MODELER_PUT(358) = G[75]*t256 - G[76]*t258 + t233;
    MODELER_PUT(446) = G[93]*t256 - G[94]*t258 + t234;
    MODELER_PUT(534) = G[111]*t256 - G[112]*t258 + t235;
    MODELER_PUT(622) = G[129]*t256 - G[130]*t258 + t236;
    const modeler_lanes t259 = t250 - t243;
    const modeler_lanes t260 = t248 + t224;
    const modeler_lanes t261 = t237 - t222;
    const modeler_lanes t262 = t1*t259 + t219*t260 - t[3]*t261;
    const modeler_lanes t263 = t[5]*t259 - t[4]*t260;
    MODELER_PUT(4) = G[3]*t262 + G[4]*t263 - G[5]*t261;
    MODELER_PUT(94) = G[21]*t262 + G[22]*t263 - G[23]*t261;
    MODELER_PUT(183) = G[39]*t262 + G[40]*t263 - G[41]*t261;
    MODELER_PUT(271) = G[57]*t262 + G[58]*t263 - G[59]*t261;
    MODELER_PUT(359) = G[75]*t262 + G[76]*t263 - G[77]*t261;
    MODELER_PUT(447) = G[93]*t262 + G[94]*t263 - G[95]*t261;
    MODELER_PUT(535) = G[111]*t262 + G[112]*t263 - G[113]*t261;
    MODELER_PUT(623) = G[129]*t262 + G[130]*t263 - G[131]*t261;
    const modeler_lanes t264 = t223 + t255 - t[3]*t248;
    const modeler_lanes t265 = t227 - t257;
    MODELER_PUT(5) = G[3]*t264 - G[4]*t265 - G[5]*t248;
    MODELER_PUT(95) = G[21]*t264 - G[22]*t265 - G[23]*t248;
    MODELER_PUT(184) = G[39]*t264 - G[40]*t265 - G[41]*t248;
    MODELER_PUT(272) = G[57]*t264 - G[58]*t265 - G[59]*t248;
    MODELER_PUT(360) = G[75]*t264 - G[76]*t265 - G[77]*t248;
    MODELER_PUT(448) = G[93]*t264 - G[94]*t265 - G[95]*t248;
    MODELER_PUT(536) = G[111]*t264 - G[112]*t265 - G[113]*t248;
    MODELER_PUT(624) = G[129]*t264 - G[130]*t265 - G[131]*t248;
    const modeler_lanes t266 = t1*t242 - t219*t249 - t[3]*t238;
    const modeler_lanes t267 = t[4]*t4 + t[0]*t[5];
    const modeler_lanes t268 = t[0]*t[4] - t[5]*t4;
    const modeler_lanes t269 = t267*t242 + t268*t249 + t49*t238;
    const modeler_lanes t270 = t[4]*t22 - t[1]*t[5];
    const modeler_lanes t271 = t[1]*t[4] + t[5]*t22;
    const modeler_lanes t272 = t270*t242 - t271*t249 + t17*t238;
    const modeler_lanes t273 = lu[14]*(t147 - lu[95]*t209 - lu[96]*t208 - lu[97]*t207);
    const modeler_lanes t274 = lu[13]*(t117 - lu[87]*t273 - lu[88]*t209 - lu[89]*t208 -
    lu[90]*t207);
    const modeler_lanes t275 = G[2]*a[0] + G[20]*a[1] + G[38]*a[2] + G[56]*a[3] + G[74]*a[4] +
    G[92]*a[5];
    const modeler_lanes t276 = t275 + G[110]*a[6] + G[128]*a[7] - t274 + evra_geo_g;
    const modeler_lanes t277 = G[1]*a[0] + G[19]*a[1] + G[37]*a[2] + G[55]*a[3] + G[73]*a[4] +
    G[91]*a[5];
    const modeler_lanes t278 = t273 - (t277 + G[109]*a[6] + G[127]*a[7]);
    const modeler_lanes t279 = t[0]*t276 + t[1]*t278;
    const modeler_lanes t280 = t88 - lu[78]*t273 + t274 - lu[79]*t209 - lu[80]*t208 - lu[81]*t207;
    const modeler_lanes t281 = lu[12]*t280;
    const modeler_lanes t282 = G[0]*a[0] + G[18]*a[1] + G[36]*a[2] + G[54]*a[3] + G[72]*a[4] +
    G[90]*a[5];
    const modeler_lanes t283 = t281 - (t282 + G[108]*a[6] + G[126]*a[7]);
    const modeler_lanes t284 = t[2]*t279 - t[3]*t283;
    const modeler_lanes t285 = t[0]*t278 - t[1]*t276;
    const modeler_lanes t286 = t[2]*t283 + t[3]*t279;
    const modeler_lanes t287 = t[4]*t285 - t[5]*t286;
    const modeler_lanes t288 = t219*t284 - t[3]*t287;
    const modeler_lanes t289 = t[4]*t284;
    MODELER_PUT(6) = -(G[0]*t266 + G[1]*t269 - G[2]*t272 - G[3]*t288 + G[4]*t289 + G[5]*t287);
    const modeler_lanes t290 = G[18]*t266 + G[19]*t269 - G[20]*t272 - G[21]*t288 + G[22]*t289;
    MODELER_PUT(96) = -(t290 + G[23]*t287);
    const modeler_lanes t291 = G[36]*t266 + G[37]*t269 - G[38]*t272 - G[39]*t288 + G[40]*t289;
    MODELER_PUT(185) = -(t291 + G[41]*t287);
    const modeler_lanes t292 = G[54]*t266 + G[55]*t269 - G[56]*t272 - G[57]*t288 + G[58]*t289;
    MODELER_PUT(273) = -(t292 + G[59]*t287);
    const modeler_lanes t293 = G[72]*t266 + G[73]*t269 - G[74]*t272 - G[75]*t288 + G[76]*t289;
    MODELER_PUT(361) = -(t293 + G[77]*t287);
    const modeler_lanes t294 = G[90]*t266 + G[91]*t269 - G[92]*t272 - G[93]*t288 + G[94]*t289;
    MODELER_PUT(449) = -(t294 + G[95]*t287);
    const modeler_lanes t295 = G[108]*t266 + G[109]*t269 - G[110]*t272 - G[111]*t288 + G[112]*t289;
    MODELER_PUT(537) = -(t295 + G[113]*t287);
    const modeler_lanes t296 = G[126]*t266 + G[127]*t269 - G[128]*t272 - G[129]*t288 + G[130]*t289;
    MODELER_PUT(625) = -(t296 + G[131]*t287);
    const modeler_lanes t297 = t1*t260 + t219*t243 - t[3]*t240;
    const modeler_lanes t298 = t267*t260 - t268*t243 + t49*t240;
    const modeler_lanes t299 = t270*t260 + t271*t243 + t17*t240;
    const modeler_lanes t300 = t[4]*t286 + t[5]*t285;
    const modeler_lanes t301 = t1*t284 + t[3]*t300;
    const modeler_lanes t302 = t[5]*t284;
    MODELER_PUT(7) = G[0]*t297 + G[1]*t298 - G[2]*t299 + G[3]*t301 + G[4]*t302 + G[5]*t300;
    const modeler_lanes t303 = G[18]*t297 + G[19]*t298 - G[20]*t299 + G[21]*t301 + G[22]*t302;
    MODELER_PUT(97) = t303 + G[23]*t300;
    const modeler_lanes t304 = G[36]*t297 + G[37]*t298 - G[38]*t299 + G[39]*t301 + G[40]*t302;
    MODELER_PUT(186) = t304 + G[41]*t300;
    const modeler_lanes t305 = G[54]*t297 + G[55]*t298 - G[56]*t299 + G[57]*t301 + G[58]*t302;
    MODELER_PUT(274) = t305 + G[59]*t300;
    const modeler_lanes t306 = G[72]*t297 + G[73]*t298 - G[74]*t299 + G[75]*t301 + G[76]*t302;
    MODELER_PUT(362) = t306 + G[77]*t300;
    const modeler_lanes t307 = G[90]*t297 + G[91]*t298 - G[92]*t299 + G[93]*t301 + G[94]*t302;
    MODELER_PUT(450) = t307 + G[95]*t300;
    const modeler_lanes t308 = G[108]*t297 + G[109]*t298 - G[110]*t299 + G[111]*t301 + G[112]*t302;
    MODELER_PUT(538) = t308 + G[113]*t300;
    const modeler_lanes t309 = G[126]*t297 + G[127]*t298 - G[128]*t299 + G[129]*t301 + G[130]*t302;
    MODELER_PUT(626) = t309 + G[131]*t300;
    const modeler_lanes t310 = t1*t261 + t219*t252 + t[3]*t250;
    const modeler_lanes t311 = t267*t261 - t268*t252 - t49*t250;
    const modeler_lanes t312 = t270*t261 + t271*t252 - t17*t250;
    const modeler_lanes t313 = t1*t287 + t219*t300;
    MODELER_PUT(8) = -(G[0]*t310 + G[1]*t311 - G[2]*t312 - G[3]*t313 + G[4]*t286);
    MODELER_PUT(98) = -(G[18]*t310 + G[19]*t311 - G[20]*t312 - G[21]*t313 + G[22]*t286);
    MODELER_PUT(187) = -(G[36]*t310 + G[37]*t311 - G[38]*t312 - G[39]*t313 + G[40]*t286);
    MODELER_PUT(275) = -(G[54]*t310 + G[55]*t311 - G[56]*t312 - G[57]*t313 + G[58]*t286);
    MODELER_PUT(363) = -(G[72]*t310 + G[73]*t311 - G[74]*t312 - G[75]*t313 + G[76]*t286);
    MODELER_PUT(451) = -(G[90]*t310 + G[91]*t311 - G[92]*t312 - G[93]*t313 + G[94]*t286);
    MODELER_PUT(539) = -(G[108]*t310 + G[109]*t311 - G[110]*t312 - G[111]*t313 + G[112]*t286);
    MODELER_PUT(627) = -(G[126]*t310 + G[127]*t311 - G[128]*t312 - G[129]*t313 + G[130]*t286);
    MODELER_PUT(9) = G[2]*t276 - (G[0]*t283 + G[1]*t278);
    MODELER_PUT(99) = G[20]*t276 - (G[18]*t283 + G[19]*t278);
    MODELER_PUT(188) = G[38]*t276 - (G[36]*t283 + G[37]*t278);
    MODELER_PUT(276) = G[56]*t276 - (G[54]*t283 + G[55]*t278);
    MODELER_PUT(364) = G[74]*t276 - (G[72]*t283 + G[73]*t278);
    MODELER_PUT(452) = G[92]*t276 - (G[90]*t283 + G[91]*t278);
    MODELER_PUT(540) = G[110]*t276 - (G[108]*t283 + G[109]*t278);
    MODELER_PUT(628) = G[128]*t276 - (G[126]*t283 + G[127]*t278);
    MODELER_PUT(10) = a[0];
    MODELER_PUT(11) = a[0];
    MODELER_PUT(100) = a[1];
    const modeler_lanes t314 = lu[1]*(t87 - lu[23]*t281 + t273 - lu[24]*t209 - lu[25]*t208 -
    lu[26]*t207);
    const modeler_lanes t315 = G[6]*a[0] + G[24]*a[1] + G[42]*a[2] + G[60]*a[3] + G[78]*a[4] +
    G[96]*a[5];
    const modeler_lanes t316 = lu[0]*(t79 + t281 - lu[18]*t208 - lu[19]*t207 - lu[20]*t314);
    const modeler_lanes t317 = t316 - (t315 + G[114]*a[6] + G[132]*a[7]);
    MODELER_PUT(12) = -G[6]*t317;
    MODELER_PUT(101) = -G[24]*t317;
    MODELER_PUT(189) = -G[42]*t317;
    MODELER_PUT(277) = -G[60]*t317;
    MODELER_PUT(365) = -G[78]*t317;
    MODELER_PUT(453) = -G[96]*t317;
    MODELER_PUT(541) = -G[114]*t317;
    MODELER_PUT(629) = -G[132]*t317;
    const modeler_lanes t318 = t62*t62;
    const modeler_lanes t319 = x_B1_x*a[0] + x_B1_y*a[1];
    const modeler_lanes t320 = evra_geo_g*t[7] - t[6]*t319;
    MODELER_PUT(13) = t74*t318 + t72*t317 + G[6]*t320;
    MODELER_PUT(102) = t82*t318 + t80*t317 + G[24]*t320;
    MODELER_PUT(190) = G[42]*t320;
    MODELER_PUT(278) = G[60]*t320;
    MODELER_PUT(366) = G[78]*t320;
    MODELER_PUT(454) = G[96]*t320;
    MODELER_PUT(542) = G[114]*t320;
    MODELER_PUT(630) = G[132]*t320;
    const modeler_lanes t321 = t74*t317 - t72*t318;
    const modeler_lanes t322 = t[7]*t319 + evra_geo_g*t[6];
    MODELER_PUT(14) = G[6]*t322 - t321;
    const modeler_lanes t323 = t82*t317 - t80*t318;
    MODELER_PUT(103) = G[24]*t322 - t323;
    MODELER_PUT(191) = G[42]*t322;
    MODELER_PUT(279) = G[60]*t322;
    MODELER_PUT(367) = G[78]*t322;
    MODELER_PUT(455) = G[96]*t322;
    MODELER_PUT(543) = G[114]*t322;
    MODELER_PUT(631) = G[132]*t322;
    const modeler_lanes t324 = t[8]*t317;
    const modeler_lanes t325 = t[9]*t62;
    const modeler_lanes t326 = t65*t325;
    const modeler_lanes t327 = t324 + t326;
    const modeler_lanes t328 = t[8]*t62;
    const modeler_lanes t329 = t65*t328;
    const modeler_lanes t330 = t[8]*t327 + t[9]*t329;
    const modeler_lanes t331 = t328*t325;
    MODELER_PUT(15) = G[7]*t331 - G[6]*t330;
    MODELER_PUT(104) = G[25]*t331 - G[24]*t330;
    MODELER_PUT(192) = G[43]*t331 - G[42]*t330;
    MODELER_PUT(280) = G[61]*t331 - G[60]*t330;
    MODELER_PUT(368) = G[79]*t331 - G[78]*t330;
    MODELER_PUT(456) = G[97]*t331 - G[96]*t330;
    MODELER_PUT(544) = G[115]*t331 - G[114]*t330;
    MODELER_PUT(632) = G[133]*t331 - G[132]*t330;
    const modeler_lanes t332 = t[9]*t317;
    const modeler_lanes t333 = t329 - t332 + t329;
    const modeler_lanes t334 = t326 + t327;
    const modeler_lanes t335 = t[8]*t333 - t[9]*t334;
    const modeler_lanes t336 = t65*t65;
    const modeler_lanes t337 = t325*t325 + t336;
    const modeler_lanes t338 = t328*t328 + t336;
    const modeler_lanes t339 = t337 - t338;
    MODELER_PUT(16) = -(G[6]*t335 + G[7]*t339);
    MODELER_PUT(105) = -(G[24]*t335 + G[25]*t339);
    MODELER_PUT(193) = -(G[42]*t335 + G[43]*t339);
    MODELER_PUT(281) = -(G[60]*t335 + G[61]*t339);
    MODELER_PUT(369) = -(G[78]*t335 + G[79]*t339);
    MODELER_PUT(457) = -(G[96]*t335 + G[97]*t339);
    MODELER_PUT(545) = -(G[114]*t335 + G[115]*t339);
    MODELER_PUT(633) = -(G[132]*t335 + G[133]*t339);
    const modeler_lanes t340 = G[7]*a[0] + G[25]*a[1] + G[43]*a[2] + G[61]*a[3] + G[79]*a[4] +
    G[97]*a[5];
    const modeler_lanes t341 = t314 - (t340 + G[115]*a[6] + G[133]*a[7]);
    const modeler_lanes t342 = t341 + t331;
    const modeler_lanes t343 = t[8]*t342 - t[9]*(t318 - t337);
    MODELER_PUT(17) = -(G[6]*t343 + G[7]*t324);
    MODELER_PUT(106) = -(G[24]*t343 + G[25]*t324);
    MODELER_PUT(194) = -(G[42]*t343 + G[43]*t324);
    MODELER_PUT(282) = -(G[60]*t343 + G[61]*t324);
    MODELER_PUT(370) = -(G[78]*t343 + G[79]*t324);
    MODELER_PUT(458) = -(G[96]*t343 + G[97]*t324);
    MODELER_PUT(546) = -(G[114]*t343 + G[115]*t324);
    MODELER_PUT(634) = -(G[132]*t343 + G[133]*t324);
    const modeler_lanes t344 = t341 - t331;
    const modeler_lanes t345 = t[8]*(t318 - t338) + t[9]*t344;
    MODELER_PUT(18) = G[6]*t345 + G[7]*t332;
    MODELER_PUT(107) = G[24]*t345 + G[25]*t332;
    MODELER_PUT(195) = G[42]*t345 + G[43]*t332;
    MODELER_PUT(283) = G[60]*t345 + G[61]*t332;
    MODELER_PUT(371) = G[78]*t345 + G[79]*t332;
    MODELER_PUT(459) = G[96]*t345 + G[97]*t332;
    MODELER_PUT(547) = G[114]*t345 + G[115]*t332;
    MODELER_PUT(635) = G[132]*t345 + G[133]*t332;
    MODELER_PUT(19) = -G[7]*t341;
    MODELER_PUT(108) = -G[25]*t341;
    MODELER_PUT(196) = -G[43]*t341;
    MODELER_PUT(284) = -G[61]*t341;
    MODELER_PUT(372) = -G[79]*t341;
    MODELER_PUT(460) = -G[97]*t341;
    MODELER_PUT(548) = -G[115]*t341;
    MODELER_PUT(636) = -G[133]*t341;
    const modeler_lanes t346 = x_B1_y*t[9] + t[8]*t74;
    const modeler_lanes t347 = t75*t337 + t346*t342 - t72*t333;
    const modeler_lanes t348 = t[9]*t320;
    const modeler_lanes t349 = x_B1_x*a[1] - x_B1_y*a[0];
    const modeler_lanes t350 = t[9]*t349 - t[8]*t322;
    MODELER_PUT(20) = -(t347 + G[6]*t348 + G[7]*t350);
    const modeler_lanes t351 = x_B1_x*t[9] - t[8]*t82;
    const modeler_lanes t352 = t83*t337 - t351*t342 - t80*t333;
    MODELER_PUT(109) = -(t352 + G[24]*t348 + G[25]*t350);
    MODELER_PUT(197) = -(G[42]*t348 + G[43]*t350);
    MODELER_PUT(285) = -(G[60]*t348 + G[61]*t350);
    MODELER_PUT(373) = -(G[78]*t348 + G[79]*t350);
    MODELER_PUT(461) = -(G[96]*t348 + G[97]*t350);
    MODELER_PUT(549) = -(G[114]*t348 + G[115]*t350);
    MODELER_PUT(637) = -(G[132]*t348 + G[133]*t350);
    const modeler_lanes t353 = t75*t344 - t346*t338 - t72*t334;
    const modeler_lanes t354 = t[8]*t320;
    const modeler_lanes t355 = t[9]*t322 + t[8]*t349;
    MODELER_PUT(21) = t353 - G[6]*t354 - G[7]*t355;
    const modeler_lanes t356 = t83*t344 + t351*t338 - t80*t334;
    MODELER_PUT(110) = t356 - G[24]*t354 - G[25]*t355;
    MODELER_PUT(198) = -(G[42]*t354 + G[43]*t355);
    MODELER_PUT(286) = -(G[60]*t354 + G[61]*t355);
    MODELER_PUT(374) = -(G[78]*t354 + G[79]*t355);
    MODELER_PUT(462) = -(G[96]*t354 + G[97]*t355);
    MODELER_PUT(550) = -(G[114]*t354 + G[115]*t355);
    MODELER_PUT(638) = -(G[132]*t354 + G[133]*t355);
    const modeler_lanes t357 = t320 - q[10]*t334 + v[2]*t328*2.0;
    const modeler_lanes t358 = q[10]*t[8];
    const modeler_lanes t359 = t[9]*t357 + t333*t358;
    const modeler_lanes t360 = t350 - q[10]*t338 + a[2];
    const modeler_lanes t361 = t360 + q[10]*t337;
    MODELER_PUT(22) = -(t347 + G[6]*t359 + G[7]*t361);
    MODELER_PUT(111) = -(t352 + G[24]*t359 + G[25]*t361);
    MODELER_PUT(199) = t342 - (G[42]*t359 + G[43]*t361);
    MODELER_PUT(287) = -(G[60]*t359 + G[61]*t361);
    MODELER_PUT(375) = -(G[78]*t359 + G[79]*t361);
    MODELER_PUT(463) = -(G[96]*t359 + G[97]*t361);
    MODELER_PUT(551) = -(G[114]*t359 + G[115]*t361);
    MODELER_PUT(639) = -(G[132]*t359 + G[133]*t361);
    const modeler_lanes t362 = q[10]*t344;
    const modeler_lanes t363 = t355 - t362 + v[2]*t65*2.0;
    const modeler_lanes t364 = t[8]*t360 - t[9]*t363 + t318*t358;
    const modeler_lanes t365 = q[10]*t332;
    MODELER_PUT(23) = t321 + G[6]*t364 + G[7]*t365;
    MODELER_PUT(112) = t323 + G[24]*t364 + G[25]*t365;
    MODELER_PUT(200) = G[42]*t364 + G[43]*t365 - t324;
    MODELER_PUT(288) = G[60]*t364 + G[61]*t365;
    MODELER_PUT(376) = G[78]*t364 + G[79]*t365;
    MODELER_PUT(464) = G[96]*t364 + G[97]*t365;
    MODELER_PUT(552) = G[114]*t364 + G[115]*t365;
    MODELER_PUT(640) = G[132]*t364 + G[133]*t365;
    const modeler_lanes t366 = t[8]*t357 - t334*t358;
    const modeler_lanes t367 = t362 - t363;
    MODELER_PUT(24) = -(t353 - G[6]*t366 + G[7]*t367);
    MODELER_PUT(113) = -(t356 - G[24]*t366 + G[25]*t367);
    MODELER_PUT(201) = G[42]*t366 - G[43]*t367 - t338;
    MODELER_PUT(289) = G[60]*t366 - G[61]*t367;
    MODELER_PUT(377) = G[78]*t366 - G[79]*t367;
    MODELER_PUT(465) = G[96]*t366 - G[97]*t367;
    MODELER_PUT(553) = G[114]*t366 - G[115]*t367;
    MODELER_PUT(641) = G[132]*t366 - G[133]*t367;
    const modeler_lanes t368 = t115 - lu[33]*t281 + t273 - lu[34]*t209 - lu[35]*t208 - lu[36]*t207;
    const modeler_lanes t369 = lu[3]*t368;
    const modeler_lanes t370 = G[8]*a[0] + G[26]*a[1] + G[44]*a[2] + G[62]*a[3] + G[80]*a[4] +
    G[98]*a[5];
    const modeler_lanes t371 = lu[2]*(t107 + t281 - lu[28]*t208 - lu[29]*t207 - lu[30]*t369);
    const modeler_lanes t372 = t371 - (t370 + G[116]*a[6] + G[134]*a[7]);
    MODELER_PUT(25) = -G[8]*t372;
    MODELER_PUT(114) = -G[26]*t372;
    MODELER_PUT(202) = -G[44]*t372;
    MODELER_PUT(290) = -G[62]*t372;
    MODELER_PUT(378) = -G[80]*t372;
    MODELER_PUT(466) = -G[98]*t372;
    MODELER_PUT(554) = -G[116]*t372;
    MODELER_PUT(642) = -G[134]*t372;
    const modeler_lanes t373 = t90*t90;
    const modeler_lanes t374 = x_B2_x*a[0] + x_B2_y*a[1];
    const modeler_lanes t375 = evra_geo_g*t[11] - t[10]*t374;
    MODELER_PUT(26) = t102*t373 + t100*t372 + G[8]*t375;
    MODELER_PUT(115) = t110*t373 + t108*t372 + G[26]*t375;
    MODELER_PUT(203) = G[44]*t375;
    MODELER_PUT(291) = G[62]*t375;
    MODELER_PUT(379) = G[80]*t375;
    MODELER_PUT(467) = G[98]*t375;
    MODELER_PUT(555) = G[116]*t375;
    MODELER_PUT(643) = G[134]*t375;
    const modeler_lanes t376 = t102*t372 - t100*t373;
    const modeler_lanes t377 = t[11]*t374 + evra_geo_g*t[10];
    MODELER_PUT(27) = G[8]*t377 - t376;
    const modeler_lanes t378 = t110*t372 - t108*t373;
    MODELER_PUT(116) = G[26]*t377 - t378;
    MODELER_PUT(204) = G[44]*t377;
    MODELER_PUT(292) = G[62]*t377;
    MODELER_PUT(380) = G[80]*t377;
    MODELER_PUT(468) = G[98]*t377;
    MODELER_PUT(556) = G[116]*t377;
    MODELER_PUT(644) = G[134]*t377;
    const modeler_lanes t379 = t[12]*t372;
    const modeler_lanes t380 = t[13]*t90;
    const modeler_lanes t381 = t93*t380;
    const modeler_lanes t382 = t379 + t381;
    const modeler_lanes t383 = t[12]*t90;
    const modeler_lanes t384 = t93*t383;
    const modeler_lanes t385 = t[12]*t382 + t[13]*t384;
    const modeler_lanes t386 = t383*t380;
    MODELER_PUT(28) = G[9]*t386 - G[8]*t385;
    MODELER_PUT(117) = G[27]*t386 - G[26]*t385;
    MODELER_PUT(205) = G[45]*t386 - G[44]*t385;
    MODELER_PUT(293) = G[63]*t386 - G[62]*t385;
    MODELER_PUT(381) = G[81]*t386 - G[80]*t385;
    MODELER_PUT(469) = G[99]*t386 - G[98]*t385;
    MODELER_PUT(557) = G[117]*t386 - G[116]*t385;
    MODELER_PUT(645) = G[135]*t386 - G[134]*t385;
    const modeler_lanes t387 = t[13]*t372;
    const modeler_lanes t388 = t384 - t387 + t384;
    const modeler_lanes t389 = t381 + t382;
    const modeler_lanes t390 = t[12]*t388 - t[13]*t389;
    const modeler_lanes t391 = t93*t93;
    const modeler_lanes t392 = t380*t380 + t391;
    const modeler_lanes t393 = t383*t383 + t391;
    const modeler_lanes t394 = t392 - t393;
    MODELER_PUT(29) = -(G[8]*t390 + G[9]*t394);
    MODELER_PUT(118) = -(G[26]*t390 + G[27]*t394);
    MODELER_PUT(206) = -(G[44]*t390 + G[45]*t394);
    MODELER_PUT(294) = -(G[62]*t390 + G[63]*t394);
    MODELER_PUT(382) = -(G[80]*t390 + G[81]*t394);
    MODELER_PUT(470) = -(G[98]*t390 + G[99]*t394);
    MODELER_PUT(558) = -(G[116]*t390 + G[117]*t394);
    MODELER_PUT(646) = -(G[134]*t390 + G[135]*t394);
    const modeler_lanes t395 = G[9]*a[0] + G[27]*a[1] + G[45]*a[2] + G[63]*a[3] + G[81]*a[4] +
    G[99]*a[5];
    const modeler_lanes t396 = t369 - (t395 + G[117]*a[6] + G[135]*a[7]);
    const modeler_lanes t397 = t396 + t386;
    const modeler_lanes t398 = t[12]*t397 - t[13]*(t373 - t392);
    MODELER_PUT(30) = -(G[8]*t398 + G[9]*t379);
    MODELER_PUT(119) = -(G[26]*t398 + G[27]*t379);
    MODELER_PUT(207) = -(G[44]*t398 + G[45]*t379);
    MODELER_PUT(295) = -(G[62]*t398 + G[63]*t379);
    MODELER_PUT(383) = -(G[80]*t398 + G[81]*t379);
    MODELER_PUT(471) = -(G[98]*t398 + G[99]*t379);
    MODELER_PUT(559) = -(G[116]*t398 + G[117]*t379);
    MODELER_PUT(647) = -(G[134]*t398 + G[135]*t379);
    const modeler_lanes t399 = t396 - t386;
    const modeler_lanes t400 = t[12]*(t373 - t393) + t[13]*t399;
    MODELER_PUT(31) = G[8]*t400 + G[9]*t387;
    MODELER_PUT(120) = G[26]*t400 + G[27]*t387;
    MODELER_PUT(208) = G[44]*t400 + G[45]*t387;
    MODELER_PUT(296) = G[62]*t400 + G[63]*t387;
    MODELER_PUT(384) = G[80]*t400 + G[81]*t387;
    MODELER_PUT(472) = G[98]*t400 + G[99]*t387;
    MODELER_PUT(560) = G[116]*t400 + G[117]*t387;
    MODELER_PUT(648) = G[134]*t400 + G[135]*t387;
    MODELER_PUT(32) = -G[9]*t396;
    MODELER_PUT(121) = -G[27]*t396;
    MODELER_PUT(209) = -G[45]*t396;
    MODELER_PUT(297) = -G[63]*t396;
    MODELER_PUT(385) = -G[81]*t396;
    MODELER_PUT(473) = -G[99]*t396;
    MODELER_PUT(561) = -G[117]*t396;
    MODELER_PUT(649) = -G[135]*t396;
    const modeler_lanes t401 = x_B2_y*t[13] + t[12]*t102;
    const modeler_lanes t402 = t103*t392 + t401*t397 - t100*t388;
    const modeler_lanes t403 = t[13]*t375;
    const modeler_lanes t404 = x_B2_x*a[1] - x_B2_y*a[0];
    const modeler_lanes t405 = t[13]*t404 - t[12]*t377;
    MODELER_PUT(33) = -(t402 + G[8]*t403 + G[9]*t405);
    const modeler_lanes t406 = x_B2_x*t[13] - t[12]*t110;
    const modeler_lanes t407 = t111*t392 - t406*t397 - t108*t388;
    MODELER_PUT(122) = -(t407 + G[26]*t403 + G[27]*t405);
    MODELER_PUT(210) = -(G[44]*t403 + G[45]*t405);
    MODELER_PUT(298) = -(G[62]*t403 + G[63]*t405);
    MODELER_PUT(386) = -(G[80]*t403 + G[81]*t405);
    MODELER_PUT(474) = -(G[98]*t403 + G[99]*t405);
    MODELER_PUT(562) = -(G[116]*t403 + G[117]*t405);
    MODELER_PUT(650) = -(G[134]*t403 + G[135]*t405);
    const modeler_lanes t408 = t103*t399 - t401*t393 - t100*t389;
    const modeler_lanes t409 = t[12]*t375;
    const modeler_lanes t410 = t[13]*t377 + t[12]*t404;
    MODELER_PUT(34) = t408 - G[8]*t409 - G[9]*t410;
    const modeler_lanes t411 = t111*t399 + t406*t393 - t108*t389;
    MODELER_PUT(123) = t411 - G[26]*t409 - G[27]*t410;
    MODELER_PUT(211) = -(G[44]*t409 + G[45]*t410);
    MODELER_PUT(299) = -(G[62]*t409 + G[63]*t410);
    MODELER_PUT(387) = -(G[80]*t409 + G[81]*t410);
    MODELER_PUT(475) = -(G[98]*t409 + G[99]*t410);
    MODELER_PUT(563) = -(G[116]*t409 + G[117]*t410);
    MODELER_PUT(651) = -(G[134]*t409 + G[135]*t410);
    const modeler_lanes t412 = t375 - q[13]*t389 + v[3]*t383*2.0;
    const modeler_lanes t413 = q[13]*t[12];
    const modeler_lanes t414 = t[13]*t412 + t388*t413;
    const modeler_lanes t415 = t405 - q[13]*t393 + a[3];
    const modeler_lanes t416 = t415 + q[13]*t392;
    MODELER_PUT(35) = -(t402 + G[8]*t414 + G[9]*t416);
    MODELER_PUT(124) = -(t407 + G[26]*t414 + G[27]*t416);
    MODELER_PUT(212) = -(G[44]*t414 + G[45]*t416);
    MODELER_PUT(300) = t397 - (G[62]*t414 + G[63]*t416);
    MODELER_PUT(388) = -(G[80]*t414 + G[81]*t416);
    MODELER_PUT(476) = -(G[98]*t414 + G[99]*t416);
    MODELER_PUT(564) = -(G[116]*t414 + G[117]*t416);
    MODELER_PUT(652) = -(G[134]*t414 + G[135]*t416);
    const modeler_lanes t417 = q[13]*t399;
    const modeler_lanes t418 = t410 - t417 + v[3]*t93*2.0;
    const modeler_lanes t419 = t[12]*t415 - t[13]*t418 + t373*t413;
    const modeler_lanes t420 = q[13]*t387;
    MODELER_PUT(36) = t376 + G[8]*t419 + G[9]*t420;
    MODELER_PUT(125) = t378 + G[26]*t419 + G[27]*t420;
    MODELER_PUT(213) = G[44]*t419 + G[45]*t420;
    MODELER_PUT(301) = G[62]*t419 + G[63]*t420 - t379;
    MODELER_PUT(389) = G[80]*t419 + G[81]*t420;
    MODELER_PUT(477) = G[98]*t419 + G[99]*t420;
    MODELER_PUT(565) = G[116]*t419 + G[117]*t420;
    MODELER_PUT(653) = G[134]*t419 + G[135]*t420;
    const modeler_lanes t421 = t[12]*t412 - t389*t413;
    const modeler_lanes t422 = t417 - t418;
    MODELER_PUT(37) = -(t408 - G[8]*t421 + G[9]*t422);
    MODELER_PUT(126) = -(t411 - G[26]*t421 + G[27]*t422);
    MODELER_PUT(214) = G[44]*t421 - G[45]*t422;
    MODELER_PUT(302) = G[62]*t421 - G[63]*t422 - t393;
    MODELER_PUT(390) = G[80]*t421 - G[81]*t422;
    MODELER_PUT(478) = G[98]*t421 - G[99]*t422;
    MODELER_PUT(566) = G[116]*t421 - G[117]*t422;
    MODELER_PUT(654) = G[134]*t421 - G[135]*t422;
    const modeler_lanes t423 = t145 - lu[43]*t281 + t273 - lu[44]*t209 - lu[45]*t208 - lu[46]*t207;
    const modeler_lanes t424 = lu[5]*t423;
    const modeler_lanes t425 = G[10]*a[0] + G[28]*a[1] + G[46]*a[2] + G[64]*a[3] + G[82]*a[4];
    const modeler_lanes t426 = lu[4]*(t137 + t281 - lu[38]*t208 - lu[39]*t207 - lu[40]*t424);
    const modeler_lanes t427 = t426 - (t425 + G[100]*a[5] + G[118]*a[6] + G[136]*a[7]);
    MODELER_PUT(38) = -G[10]*t427;
    MODELER_PUT(127) = -G[28]*t427;
    MODELER_PUT(215) = -G[46]*t427;
    MODELER_PUT(303) = -G[64]*t427;
    MODELER_PUT(391) = -G[82]*t427;
    MODELER_PUT(479) = -G[100]*t427;
    MODELER_PUT(567) = -G[118]*t427;
    MODELER_PUT(655) = -G[136]*t427;
    const modeler_lanes t428 = t120*t120;
    const modeler_lanes t429 = x_B3_x*a[0] + x_B3_y*a[1];
    const modeler_lanes t430 = evra_geo_g*t[15] - t[14]*t429;
    MODELER_PUT(39) = t132*t428 + t130*t427 + G[10]*t430;
    MODELER_PUT(128) = t140*t428 + t138*t427 + G[28]*t430;
    MODELER_PUT(216) = G[46]*t430;
    MODELER_PUT(304) = G[64]*t430;
    MODELER_PUT(392) = G[82]*t430;
    MODELER_PUT(480) = G[100]*t430;
    MODELER_PUT(568) = G[118]*t430;
    MODELER_PUT(656) = G[136]*t430;
    const modeler_lanes t431 = t132*t427 - t130*t428;
    const modeler_lanes t432 = t[15]*t429 + evra_geo_g*t[14];
    MODELER_PUT(40) = G[10]*t432 - t431;
    const modeler_lanes t433 = t140*t427 - t138*t428;
    MODELER_PUT(129) = G[28]*t432 - t433;
    MODELER_PUT(217) = G[46]*t432;
    MODELER_PUT(305) = G[64]*t432;
    MODELER_PUT(393) = G[82]*t432;
    MODELER_PUT(481) = G[100]*t432;
    MODELER_PUT(569) = G[118]*t432;
    MODELER_PUT(657) = G[136]*t432;
    const modeler_lanes t434 = t[16]*t427;
    const modeler_lanes t435 = t[17]*t120;
    const modeler_lanes t436 = t123*t435;
    const modeler_lanes t437 = t434 + t436;
    const modeler_lanes t438 = t[16]*t120;
    const modeler_lanes t439 = t123*t438;
    const modeler_lanes t440 = t[16]*t437 + t[17]*t439;
    const modeler_lanes t441 = t438*t435;
    MODELER_PUT(41) = G[11]*t441 - G[10]*t440;
    MODELER_PUT(130) = G[29]*t441 - G[28]*t440;
    MODELER_PUT(218) = G[47]*t441 - G[46]*t440;
    MODELER_PUT(306) = G[65]*t441 - G[64]*t440;
    MODELER_PUT(394) = G[83]*t441 - G[82]*t440;
    MODELER_PUT(482) = G[101]*t441 - G[100]*t440;
    MODELER_PUT(570) = G[119]*t441 - G[118]*t440;
    MODELER_PUT(658) = G[137]*t441 - G[136]*t440;
    const modeler_lanes t442 = t[17]*t427;
    const modeler_lanes t443 = t439 - t442 + t439;
    const modeler_lanes t444 = t436 + t437;
    const modeler_lanes t445 = t[16]*t443 - t[17]*t444;
    const modeler_lanes t446 = t123*t123;
    const modeler_lanes t447 = t435*t435 + t446;
    const modeler_lanes t448 = t438*t438 + t446;
    const modeler_lanes t449 = t447 - t448;
    MODELER_PUT(42) = -(G[10]*t445 + G[11]*t449);
    MODELER_PUT(131) = -(G[28]*t445 + G[29]*t449);
    MODELER_PUT(219) = -(G[46]*t445 + G[47]*t449);
    MODELER_PUT(307) = -(G[64]*t445 + G[65]*t449);
    MODELER_PUT(395) = -(G[82]*t445 + G[83]*t449);
    MODELER_PUT(483) = -(G[100]*t445 + G[101]*t449);
    MODELER_PUT(571) = -(G[118]*t445 + G[119]*t449);
    MODELER_PUT(659) = -(G[136]*t445 + G[137]*t449);
    const modeler_lanes t450 = G[11]*a[0] + G[29]*a[1] + G[47]*a[2] + G[65]*a[3] + G[83]*a[4];
    const modeler_lanes t451 = t424 - (t450 + G[101]*a[5] + G[119]*a[6] + G[137]*a[7]);
    const modeler_lanes t452 = t451 + t441;
    const modeler_lanes t453 = t[16]*t452 - t[17]*(t428 - t447);
    MODELER_PUT(43) = -(G[10]*t453 + G[11]*t434);
    MODELER_PUT(132) = -(G[28]*t453 + G[29]*t434);
    MODELER_PUT(220) = -(G[46]*t453 + G[47]*t434);
    MODELER_PUT(308) = -(G[64]*t453 + G[65]*t434);
    MODELER_PUT(396) = -(G[82]*t453 + G[83]*t434);
    MODELER_PUT(484) = -(G[100]*t453 + G[101]*t434);
    MODELER_PUT(572) = -(G[118]*t453 + G[119]*t434);
    MODELER_PUT(660) = -(G[136]*t453 + G[137]*t434);
    const modeler_lanes t454 = t451 - t441;
    const modeler_lanes t455 = t[16]*(t428 - t448) + t[17]*t454;
    MODELER_PUT(44) = G[10]*t455 + G[11]*t442;
    MODELER_PUT(133) = G[28]*t455 + G[29]*t442;
    MODELER_PUT(221) = G[46]*t455 + G[47]*t442;
    MODELER_PUT(309) = G[64]*t455 + G[65]*t442;
    MODELER_PUT(397) = G[82]*t455 + G[83]*t442;
    MODELER_PUT(485) = G[100]*t455 + G[101]*t442;
    MODELER_PUT(573) = G[118]*t455 + G[119]*t442;
    MODELER_PUT(661) = G[136]*t455 + G[137]*t442;
    MODELER_PUT(45) = -G[11]*t451;
    MODELER_PUT(134) = -G[29]*t451;
    MODELER_PUT(222) = -G[47]*t451;
    MODELER_PUT(310) = -G[65]*t451;
    MODELER_PUT(398) = -G[83]*t451;
    MODELER_PUT(486) = -G[101]*t451;
    MODELER_PUT(574) = -G[119]*t451;
    MODELER_PUT(662) = -G[137]*t451;
    const modeler_lanes t456 = x_B3_y*t[17] + t[16]*t132;
    const modeler_lanes t457 = t133*t447 + t456*t452 - t130*t443;
    const modeler_lanes t458 = t[17]*t430;
    const modeler_lanes t459 = x_B3_x*a[1] - x_B3_y*a[0];
    const modeler_lanes t460 = t[17]*t459 - t[16]*t432;
    MODELER_PUT(46) = -(t457 + G[10]*t458 + G[11]*t460);
    const modeler_lanes t461 = x_B3_x*t[17] - t[16]*t140;
    const modeler_lanes t462 = t141*t447 - t461*t452 - t138*t443;
    MODELER_PUT(135) = -(t462 + G[28]*t458 + G[29]*t460);
    MODELER_PUT(223) = -(G[46]*t458 + G[47]*t460);
    MODELER_PUT(311) = -(G[64]*t458 + G[65]*t460);
    MODELER_PUT(399) = -(G[82]*t458 + G[83]*t460);
    MODELER_PUT(487) = -(G[100]*t458 + G[101]*t460);
    MODELER_PUT(575) = -(G[118]*t458 + G[119]*t460);
    MODELER_PUT(663) = -(G[136]*t458 + G[137]*t460);
    const modeler_lanes t463 = t133*t454 - t456*t448 - t130*t444;
    const modeler_lanes t464 = t[16]*t430;
    const modeler_lanes t465 = t[17]*t432 + t[16]*t459;
    MODELER_PUT(47) = t463 - G[10]*t464 - G[11]*t465;
    const modeler_lanes t466 = t141*t454 + t461*t448 - t138*t444;
    MODELER_PUT(136) = t466 - G[28]*t464 - G[29]*t465;
    MODELER_PUT(224) = -(G[46]*t464 + G[47]*t465);
    MODELER_PUT(312) = -(G[64]*t464 + G[65]*t465);
    MODELER_PUT(400) = -(G[82]*t464 + G[83]*t465);
    MODELER_PUT(488) = -(G[100]*t464 + G[101]*t465);
    MODELER_PUT(576) = -(G[118]*t464 + G[119]*t465);
    MODELER_PUT(664) = -(G[136]*t464 + G[137]*t465);
    const modeler_lanes t467 = t430 - q[16]*t444 + v[4]*t438*2.0;
    const modeler_lanes t468 = q[16]*t[16];
    const modeler_lanes t469 = t[17]*t467 + t443*t468;
    const modeler_lanes t470 = t460 - q[16]*t448 + a[4];
    const modeler_lanes t471 = t470 + q[16]*t447;
    MODELER_PUT(48) = -(t457 + G[10]*t469 + G[11]*t471);
    MODELER_PUT(137) = -(t462 + G[28]*t469 + G[29]*t471);
    MODELER_PUT(225) = -(G[46]*t469 + G[47]*t471);
    MODELER_PUT(313) = -(G[64]*t469 + G[65]*t471);
    MODELER_PUT(401) = t452 - (G[82]*t469 + G[83]*t471);
    MODELER_PUT(489) = -(G[100]*t469 + G[101]*t471);
    MODELER_PUT(577) = -(G[118]*t469 + G[119]*t471);
    MODELER_PUT(665) = -(G[136]*t469 + G[137]*t471);
    const modeler_lanes t472 = q[16]*t454;
    const modeler_lanes t473 = t465 - t472 + v[4]*t123*2.0;
    const modeler_lanes t474 = t[16]*t470 - t[17]*t473 + t428*t468;
    const modeler_lanes t475 = q[16]*t442;
    MODELER_PUT(49) = t431 + G[10]*t474 + G[11]*t475;
    MODELER_PUT(138) = t433 + G[28]*t474 + G[29]*t475;
    MODELER_PUT(226) = G[46]*t474 + G[47]*t475;
    MODELER_PUT(314) = G[64]*t474 + G[65]*t475;
    MODELER_PUT(402) = G[82]*t474 + G[83]*t475 - t434;
    MODELER_PUT(490) = G[100]*t474 + G[101]*t475;
    MODELER_PUT(578) = G[118]*t474 + G[119]*t475;
    MODELER_PUT(666) = G[136]*t474 + G[137]*t475;
    const modeler_lanes t476 = t[16]*t467 - t444*t468;
    const modeler_lanes t477 = t472 - t473;
    MODELER_PUT(50) = -(t463 - G[10]*t476 + G[11]*t477);
    MODELER_PUT(139) = -(t466 - G[28]*t476 + G[29]*t477);
    MODELER_PUT(227) = G[46]*t476 - G[47]*t477;
    MODELER_PUT(315) = G[64]*t476 - G[65]*t477;
    MODELER_PUT(403) = G[82]*t476 - G[83]*t477 - t448;
    MODELER_PUT(491) = G[100]*t476 - G[101]*t477;
    MODELER_PUT(579) = G[118]*t476 - G[119]*t477;
    MODELER_PUT(667) = G[136]*t476 - G[137]*t477;
    const modeler_lanes t478 = lu[7]*(t60 - lu[53]*t281 + t273 - lu[54]*t209 - lu[55]*t208 -
    lu[56]*t207);
    const modeler_lanes t479 = G[12]*a[0] + G[30]*a[1] + G[48]*a[2] + G[66]*a[3] + G[84]*a[4];
    const modeler_lanes t480 = lu[6]*(t48 + t281 - lu[48]*t208 - lu[49]*t207 - lu[50]*t478);
    const modeler_lanes t481 = t480 - (t479 + G[102]*a[5] + G[120]*a[6] + G[138]*a[7]);
    MODELER_PUT(51) = -G[12]*t481;
    MODELER_PUT(140) = -G[30]*t481;
    MODELER_PUT(228) = -G[48]*t481;
    MODELER_PUT(316) = -G[66]*t481;
    MODELER_PUT(404) = -G[84]*t481;
    MODELER_PUT(492) = -G[102]*t481;
    MODELER_PUT(580) = -G[120]*t481;
    MODELER_PUT(668) = -G[138]*t481;
    const modeler_lanes t482 = t27*t27;
    const modeler_lanes t483 = x_B4_x*a[0] + x_B4_y*a[1];
    const modeler_lanes t484 = evra_geo_g*t[19] - t[18]*t483;
    MODELER_PUT(52) = t43*t482 + t41*t481 + G[12]*t484;
    MODELER_PUT(141) = t55*t482 + t53*t481 + G[30]*t484;
    MODELER_PUT(229) = G[48]*t484;
    MODELER_PUT(317) = G[66]*t484;
    MODELER_PUT(405) = G[84]*t484;
    MODELER_PUT(493) = G[102]*t484;
    MODELER_PUT(581) = G[120]*t484;
    MODELER_PUT(669) = G[138]*t484;
    const modeler_lanes t485 = t43*t481 - t41*t482;
    const modeler_lanes t486 = t[19]*t483 + evra_geo_g*t[18];
    MODELER_PUT(53) = G[12]*t486 - t485;
    const modeler_lanes t487 = t55*t481 - t53*t482;
    MODELER_PUT(142) = G[30]*t486 - t487;
    MODELER_PUT(230) = G[48]*t486;
    MODELER_PUT(318) = G[66]*t486;
    MODELER_PUT(406) = G[84]*t486;
    MODELER_PUT(494) = G[102]*t486;
    MODELER_PUT(582) = G[120]*t486;
    MODELER_PUT(670) = G[138]*t486;
    const modeler_lanes t488 = t[20]*t481;
    const modeler_lanes t489 = t[21]*t27;
    const modeler_lanes t490 = t30*t489;
    const modeler_lanes t491 = t488 + t490;
    const modeler_lanes t492 = t[20]*t27;
    const modeler_lanes t493 = t30*t492;
    const modeler_lanes t494 = t[20]*t491 + t[21]*t493;
    const modeler_lanes t495 = t492*t489;
    MODELER_PUT(54) = G[13]*t495 - G[12]*t494;
    MODELER_PUT(143) = G[31]*t495 - G[30]*t494;
    MODELER_PUT(231) = G[49]*t495 - G[48]*t494;
    MODELER_PUT(319) = G[67]*t495 - G[66]*t494;
    MODELER_PUT(407) = G[85]*t495 - G[84]*t494;
    MODELER_PUT(495) = G[103]*t495 - G[102]*t494;
    MODELER_PUT(583) = G[121]*t495 - G[120]*t494;
    MODELER_PUT(671) = G[139]*t495 - G[138]*t494;
    const modeler_lanes t496 = t[21]*t481;
    const modeler_lanes t497 = t493 - t496 + t493;
    const modeler_lanes t498 = t490 + t491;
    const modeler_lanes t499 = t[20]*t497 - t[21]*t498;
    const modeler_lanes t500 = t30*t30;
    const modeler_lanes t501 = t489*t489 + t500;
    const modeler_lanes t502 = t492*t492 + t500;
    const modeler_lanes t503 = t501 - t502;
    MODELER_PUT(55) = -(G[12]*t499 + G[13]*t503);
    MODELER_PUT(144) = -(G[30]*t499 + G[31]*t503);
    MODELER_PUT(232) = -(G[48]*t499 + G[49]*t503);
    MODELER_PUT(320) = -(G[66]*t499 + G[67]*t503);
    MODELER_PUT(408) = -(G[84]*t499 + G[85]*t503);
    MODELER_PUT(496) = -(G[102]*t499 + G[103]*t503);
    MODELER_PUT(584) = -(G[120]*t499 + G[121]*t503);
    MODELER_PUT(672) = -(G[138]*t499 + G[139]*t503);
    const modeler_lanes t504 = G[13]*a[0] + G[31]*a[1] + G[49]*a[2] + G[67]*a[3] + G[85]*a[4];
    const modeler_lanes t505 = t478 - (t504 + G[103]*a[5] + G[121]*a[6] + G[139]*a[7]);
    const modeler_lanes t506 = t505 + t495;
    const modeler_lanes t507 = t[20]*t506 - t[21]*(t482 - t501);
    MODELER_PUT(56) = -(G[12]*t507 + G[13]*t488);
    MODELER_PUT(145) = -(G[30]*t507 + G[31]*t488);
    MODELER_PUT(233) = -(G[48]*t507 + G[49]*t488);
    MODELER_PUT(321) = -(G[66]*t507 + G[67]*t488);
    MODELER_PUT(409) = -(G[84]*t507 + G[85]*t488);
    MODELER_PUT(497) = -(G[102]*t507 + G[103]*t488);
    MODELER_PUT(585) = -(G[120]*t507 + G[121]*t488);
    MODELER_PUT(673) = -(G[138]*t507 + G[139]*t488);
    const modeler_lanes t508 = t505 - t495;
    const modeler_lanes t509 = t[20]*(t482 - t502) + t[21]*t508;
    MODELER_PUT(57) = G[12]*t509 + G[13]*t496;
    MODELER_PUT(146) = G[30]*t509 + G[31]*t496;
    MODELER_PUT(234) = G[48]*t509 + G[49]*t496;
    MODELER_PUT(322) = G[66]*t509 + G[67]*t496;
    MODELER_PUT(410) = G[84]*t509 + G[85]*t496;
    MODELER_PUT(498) = G[102]*t509 + G[103]*t496;
    MODELER_PUT(586) = G[120]*t509 + G[121]*t496;
    MODELER_PUT(674) = G[138]*t509 + G[139]*t496;
    MODELER_PUT(58) = -G[13]*t505;
    MODELER_PUT(147) = -G[31]*t505;
    MODELER_PUT(235) = -G[49]*t505;
    MODELER_PUT(323) = -G[67]*t505;
    MODELER_PUT(411) = -G[85]*t505;
    MODELER_PUT(499) = -G[103]*t505;
    MODELER_PUT(587) = -G[121]*t505;
    MODELER_PUT(675) = -G[139]*t505;
    const modeler_lanes t510 = x_B4_y*t[21] + t[20]*t43;
    const modeler_lanes t511 = t44*t501 + t510*t506 - t41*t497;
    const modeler_lanes t512 = t[21]*t484;
    const modeler_lanes t513 = x_B4_x*a[1] - x_B4_y*a[0];
    const modeler_lanes t514 = t[21]*t513 - t[20]*t486;
    MODELER_PUT(59) = -(t511 + G[12]*t512 + G[13]*t514);
    const modeler_lanes t515 = x_B4_x*t[21] - t[20]*t55;
    const modeler_lanes t516 = t56*t501 - t515*t506 - t53*t497;
    MODELER_PUT(148) = -(t516 + G[30]*t512 + G[31]*t514);
    MODELER_PUT(236) = -(G[48]*t512 + G[49]*t514);
    MODELER_PUT(324) = -(G[66]*t512 + G[67]*t514);
    MODELER_PUT(412) = -(G[84]*t512 + G[85]*t514);
    MODELER_PUT(500) = -(G[102]*t512 + G[103]*t514);
    MODELER_PUT(588) = -(G[120]*t512 + G[121]*t514);
    MODELER_PUT(676) = -(G[138]*t512 + G[139]*t514);
    const modeler_lanes t517 = t44*t508 - t510*t502 - t41*t498;
    const modeler_lanes t518 = t[20]*t484;
    const modeler_lanes t519 = t[21]*t486 + t[20]*t513;
    MODELER_PUT(60) = t517 - G[12]*t518 - G[13]*t519;
    const modeler_lanes t520 = t56*t508 + t515*t502 - t53*t498;
    MODELER_PUT(149) = t520 - G[30]*t518 - G[31]*t519;
    MODELER_PUT(237) = -(G[48]*t518 + G[49]*t519);
    MODELER_PUT(325) = -(G[66]*t518 + G[67]*t519);
    MODELER_PUT(413) = -(G[84]*t518 + G[85]*t519);
    MODELER_PUT(501) = -(G[102]*t518 + G[103]*t519);
    MODELER_PUT(589) = -(G[120]*t518 + G[121]*t519);
    MODELER_PUT(677) = -(G[138]*t518 + G[139]*t519);
    const modeler_lanes t521 = t484 - q[19]*t498 + v[5]*t492*2.0;
    const modeler_lanes t522 = q[19]*t[20];
    const modeler_lanes t523 = t[21]*t521 + t497*t522;
    const modeler_lanes t524 = t514 - q[19]*t502 + a[5];
    const modeler_lanes t525 = t524 + q[19]*t501;
    MODELER_PUT(61) = -(t511 + G[12]*t523 + G[13]*t525);
    MODELER_PUT(150) = -(t516 + G[30]*t523 + G[31]*t525);
    MODELER_PUT(238) = -(G[48]*t523 + G[49]*t525);
    MODELER_PUT(326) = -(G[66]*t523 + G[67]*t525);
    MODELER_PUT(414) = -(G[84]*t523 + G[85]*t525);
    MODELER_PUT(502) = t506 - (G[102]*t523 + G[103]*t525);
    MODELER_PUT(590) = -(G[120]*t523 + G[121]*t525);
    MODELER_PUT(678) = -(G[138]*t523 + G[139]*t525);
    const modeler_lanes t526 = q[19]*t508;
    const modeler_lanes t527 = t519 - t526 + v[5]*t30*2.0;
    const modeler_lanes t528 = t[20]*t524 - t[21]*t527 + t482*t522;
    const modeler_lanes t529 = q[19]*t496;
    MODELER_PUT(62) = t485 + G[12]*t528 + G[13]*t529;
    MODELER_PUT(151) = t487 + G[30]*t528 + G[31]*t529;
    MODELER_PUT(239) = G[48]*t528 + G[49]*t529;
    MODELER_PUT(327) = G[66]*t528 + G[67]*t529;
    MODELER_PUT(415) = G[84]*t528 + G[85]*t529;
    MODELER_PUT(503) = G[102]*t528 + G[103]*t529 - t488;
    MODELER_PUT(591) = G[120]*t528 + G[121]*t529;
    MODELER_PUT(679) = G[138]*t528 + G[139]*t529;
    const modeler_lanes t530 = t[20]*t521 - t498*t522;
    const modeler_lanes t531 = t526 - t527;
    MODELER_PUT(63) = -(t517 - G[12]*t530 + G[13]*t531);
    MODELER_PUT(152) = -(t520 - G[30]*t530 + G[31]*t531);
    MODELER_PUT(240) = G[48]*t530 - G[49]*t531;
    MODELER_PUT(328) = G[66]*t530 - G[67]*t531;
    MODELER_PUT(416) = G[84]*t530 - G[85]*t531;
    MODELER_PUT(504) = G[102]*t530 - G[103]*t531 - t502;
    MODELER_PUT(592) = G[120]*t530 - G[121]*t531;
    MODELER_PUT(680) = G[138]*t530 - G[139]*t531;
    const modeler_lanes t532 = t175 - lu[63]*t281 + t273 - lu[64]*t209 - lu[65]*t208 - lu[66]*t207;
    const modeler_lanes t533 = lu[9]*t532;
    const modeler_lanes t534 = G[14]*a[0] + G[32]*a[1] + G[50]*a[2] + G[68]*a[3] + G[86]*a[4];
    const modeler_lanes t535 = lu[8]*(t167 + t281 - lu[58]*t208 - lu[59]*t207 - lu[60]*t533);
    const modeler_lanes t536 = t535 - (t534 + G[104]*a[5] + G[122]*a[6] + G[140]*a[7]);
    MODELER_PUT(64) = -G[14]*t536;
    MODELER_PUT(153) = -G[32]*t536;
    MODELER_PUT(241) = -G[50]*t536;
    MODELER_PUT(329) = -G[68]*t536;
    MODELER_PUT(417) = -G[86]*t536;
    MODELER_PUT(505) = -G[104]*t536;
    MODELER_PUT(593) = -G[122]*t536;
    MODELER_PUT(681) = -G[140]*t536;
    const modeler_lanes t537 = t150*t150;
    const modeler_lanes t538 = x_B5_x*a[0] + x_B5_y*a[1];
    const modeler_lanes t539 = evra_geo_g*t[23] - t[22]*t538;
    MODELER_PUT(65) = t162*t537 + t160*t536 + G[14]*t539;
    MODELER_PUT(154) = t170*t537 + t168*t536 + G[32]*t539;
    MODELER_PUT(242) = G[50]*t539;
    MODELER_PUT(330) = G[68]*t539;
    MODELER_PUT(418) = G[86]*t539;
    MODELER_PUT(506) = G[104]*t539;
    MODELER_PUT(594) = G[122]*t539;
    MODELER_PUT(682) = G[140]*t539;
    const modeler_lanes t540 = t162*t536 - t160*t537;
    const modeler_lanes t541 = t[23]*t538 + evra_geo_g*t[22];
    MODELER_PUT(66) = G[14]*t541 - t540;
    const modeler_lanes t542 = t170*t536 - t168*t537;
    MODELER_PUT(155) = G[32]*t541 - t542;
    MODELER_PUT(243) = G[50]*t541;
    MODELER_PUT(331) = G[68]*t541;
    MODELER_PUT(419) = G[86]*t541;
    MODELER_PUT(507) = G[104]*t541;
    MODELER_PUT(595) = G[122]*t541;
    MODELER_PUT(683) = G[140]*t541;
    const modeler_lanes t543 = t[24]*t536;
    const modeler_lanes t544 = t[25]*t150;
    const modeler_lanes t545 = t153*t544;
    const modeler_lanes t546 = t543 + t545;
    const modeler_lanes t547 = t[24]*t150;
    const modeler_lanes t548 = t153*t547;
    const modeler_lanes t549 = t[24]*t546 + t[25]*t548;
    const modeler_lanes t550 = t547*t544;
    MODELER_PUT(67) = G[15]*t550 - G[14]*t549;
    MODELER_PUT(156) = G[33]*t550 - G[32]*t549;
    MODELER_PUT(244) = G[51]*t550 - G[50]*t549;
    MODELER_PUT(332) = G[69]*t550 - G[68]*t549;
    MODELER_PUT(420) = G[87]*t550 - G[86]*t549;
    MODELER_PUT(508) = G[105]*t550 - G[104]*t549;
    MODELER_PUT(596) = G[123]*t550 - G[122]*t549;
    MODELER_PUT(684) = G[141]*t550 - G[140]*t549;
    const modeler_lanes t551 = t[25]*t536;
    const modeler_lanes t552 = t548 - t551 + t548;
    const modeler_lanes t553 = t545 + t546;
    const modeler_lanes t554 = t[24]*t552 - t[25]*t553;
    const modeler_lanes t555 = t153*t153;
    const modeler_lanes t556 = t544*t544 + t555;
    const modeler_lanes t557 = t547*t547 + t555;
    const modeler_lanes t558 = t556 - t557;
    MODELER_PUT(68) = -(G[14]*t554 + G[15]*t558);
    MODELER_PUT(157) = -(G[32]*t554 + G[33]*t558);
    MODELER_PUT(245) = -(G[50]*t554 + G[51]*t558);
    MODELER_PUT(333) = -(G[68]*t554 + G[69]*t558);
    MODELER_PUT(421) = -(G[86]*t554 + G[87]*t558);
    MODELER_PUT(509) = -(G[104]*t554 + G[105]*t558);
    MODELER_PUT(597) = -(G[122]*t554 + G[123]*t558);
    MODELER_PUT(685) = -(G[140]*t554 + G[141]*t558);
    const modeler_lanes t559 = G[15]*a[0] + G[33]*a[1] + G[51]*a[2] + G[69]*a[3] + G[87]*a[4];
    const modeler_lanes t560 = t533 - (t559 + G[105]*a[5] + G[123]*a[6] + G[141]*a[7]);
    const modeler_lanes t561 = t560 + t550;
    const modeler_lanes t562 = t[24]*t561 - t[25]*(t537 - t556);
    MODELER_PUT(69) = -(G[14]*t562 + G[15]*t543);
    MODELER_PUT(158) = -(G[32]*t562 + G[33]*t543);
    MODELER_PUT(246) = -(G[50]*t562 + G[51]*t543);
    MODELER_PUT(334) = -(G[68]*t562 + G[69]*t543);
    MODELER_PUT(422) = -(G[86]*t562 + G[87]*t543);
    MODELER_PUT(510) = -(G[104]*t562 + G[105]*t543);
    MODELER_PUT(598) = -(G[122]*t562 + G[123]*t543);
    MODELER_PUT(686) = -(G[140]*t562 + G[141]*t543);
    const modeler_lanes t563 = t560 - t550;
    const modeler_lanes t564 = t[24]*(t537 - t557) + t[25]*t563;
    MODELER_PUT(70) = G[14]*t564 + G[15]*t551;
    MODELER_PUT(159) = G[32]*t564 + G[33]*t551;
    MODELER_PUT(247) = G[50]*t564 + G[51]*t551;
    MODELER_PUT(335) = G[68]*t564 + G[69]*t551;
    MODELER_PUT(423) = G[86]*t564 + G[87]*t551;
    MODELER_PUT(511) = G[104]*t564 + G[105]*t551;
    MODELER_PUT(599) = G[122]*t564 + G[123]*t551;
    MODELER_PUT(687) = G[140]*t564 + G[141]*t551;
    MODELER_PUT(71) = -G[15]*t560;
    MODELER_PUT(160) = -G[33]*t560;
    MODELER_PUT(248) = -G[51]*t560;
    MODELER_PUT(336) = -G[69]*t560;
    MODELER_PUT(424) = -G[87]*t560;
    MODELER_PUT(512) = -G[105]*t560;
    MODELER_PUT(600) = -G[123]*t560;
    MODELER_PUT(688) = -G[141]*t560;
    const modeler_lanes t565 = x_B5_y*t[25] + t[24]*t162;
    const modeler_lanes t566 = t163*t556 + t565*t561 - t160*t552;
    const modeler_lanes t567 = t[25]*t539;
    const modeler_lanes t568 = x_B5_x*a[1] - x_B5_y*a[0];
    const modeler_lanes t569 = t[25]*t568 - t[24]*t541;
    MODELER_PUT(72) = -(t566 + G[14]*t567 + G[15]*t569);
    const modeler_lanes t570 = x_B5_x*t[25] - t[24]*t170;
    const modeler_lanes t571 = t171*t556 - t570*t561 - t168*t552;
    MODELER_PUT(161) = -(t571 + G[32]*t567 + G[33]*t569);
    MODELER_PUT(249) = -(G[50]*t567 + G[51]*t569);
    MODELER_PUT(337) = -(G[68]*t567 + G[69]*t569);
    MODELER_PUT(425) = -(G[86]*t567 + G[87]*t569);
    MODELER_PUT(513) = -(G[104]*t567 + G[105]*t569);
    MODELER_PUT(601) = -(G[122]*t567 + G[123]*t569);
    MODELER_PUT(689) = -(G[140]*t567 + G[141]*t569);
    const modeler_lanes t572 = t163*t563 - t565*t557 - t160*t553;
    const modeler_lanes t573 = t[24]*t539;
    const modeler_lanes t574 = t[25]*t541 + t[24]*t568;
    MODELER_PUT(73) = t572 - G[14]*t573 - G[15]*t574;
    const modeler_lanes t575 = t171*t563 + t570*t557 - t168*t553;
    MODELER_PUT(162) = t575 - G[32]*t573 - G[33]*t574;
    MODELER_PUT(250) = -(G[50]*t573 + G[51]*t574);
    MODELER_PUT(338) = -(G[68]*t573 + G[69]*t574);
    MODELER_PUT(426) = -(G[86]*t573 + G[87]*t574);
    MODELER_PUT(514) = -(G[104]*t573 + G[105]*t574);
    MODELER_PUT(602) = -(G[122]*t573 + G[123]*t574);
    MODELER_PUT(690) = -(G[140]*t573 + G[141]*t574);
    const modeler_lanes t576 = t539 - q[22]*t553 + v[6]*t547*2.0;
    const modeler_lanes t577 = q[22]*t[24];
    const modeler_lanes t578 = t[25]*t576 + t552*t577;
    const modeler_lanes t579 = t569 - q[22]*t557 + a[6];
    const modeler_lanes t580 = t579 + q[22]*t556;
    MODELER_PUT(74) = -(t566 + G[14]*t578 + G[15]*t580);
    MODELER_PUT(163) = -(t571 + G[32]*t578 + G[33]*t580);
    MODELER_PUT(251) = -(G[50]*t578 + G[51]*t580);
    MODELER_PUT(339) = -(G[68]*t578 + G[69]*t580);
    MODELER_PUT(427) = -(G[86]*t578 + G[87]*t580);
    MODELER_PUT(515) = -(G[104]*t578 + G[105]*t580);
    MODELER_PUT(603) = t561 - (G[122]*t578 + G[123]*t580);
    MODELER_PUT(691) = -(G[140]*t578 + G[141]*t580);
    const modeler_lanes t581 = q[22]*t563;
    const modeler_lanes t582 = t574 - t581 + v[6]*t153*2.0;
    const modeler_lanes t583 = t[24]*t579 - t[25]*t582 + t537*t577;
    const modeler_lanes t584 = q[22]*t551;
    MODELER_PUT(75) = t540 + G[14]*t583 + G[15]*t584;
    MODELER_PUT(164) = t542 + G[32]*t583 + G[33]*t584;
    MODELER_PUT(252) = G[50]*t583 + G[51]*t584;
    MODELER_PUT(340) = G[68]*t583 + G[69]*t584;
    MODELER_PUT(428) = G[86]*t583 + G[87]*t584;
    MODELER_PUT(516) = G[104]*t583 + G[105]*t584;
    MODELER_PUT(604) = G[122]*t583 + G[123]*t584 - t543;
    MODELER_PUT(692) = G[140]*t583 + G[141]*t584;
    const modeler_lanes t585 = t[24]*t576 - t553*t577;
    const modeler_lanes t586 = t581 - t582;
    MODELER_PUT(76) = -(t572 - G[14]*t585 + G[15]*t586);
    MODELER_PUT(165) = -(t575 - G[32]*t585 + G[33]*t586);
    MODELER_PUT(253) = G[50]*t585 - G[51]*t586;
    MODELER_PUT(341) = G[68]*t585 - G[69]*t586;
    MODELER_PUT(429) = G[86]*t585 - G[87]*t586;
    MODELER_PUT(517) = G[104]*t585 - G[105]*t586;
    MODELER_PUT(605) = G[122]*t585 - G[123]*t586 - t557;
    MODELER_PUT(693) = G[140]*t585 - G[141]*t586;
    const modeler_lanes t587 = t204 - lu[73]*t281 + t273 - lu[74]*t209 - lu[75]*t208 - lu[76]*t207;
    const modeler_lanes t588 = lu[11]*t587;
    const modeler_lanes t589 = G[16]*a[0] + G[34]*a[1] + G[52]*a[2] + G[70]*a[3] + G[88]*a[4];
    const modeler_lanes t590 = lu[10]*(t196 + t281 - lu[68]*t208 - lu[69]*t207 - lu[70]*t588);
    const modeler_lanes t591 = t590 - (t589 + G[106]*a[5] + G[124]*a[6] + G[142]*a[7]);
    MODELER_PUT(77) = -G[16]*t591;
    MODELER_PUT(166) = -G[34]*t591;
    MODELER_PUT(254) = -G[52]*t591;
    MODELER_PUT(342) = -G[70]*t591;
    MODELER_PUT(430) = -G[88]*t591;
    MODELER_PUT(518) = -G[106]*t591;
    MODELER_PUT(606) = -G[124]*t591;
    MODELER_PUT(694) = -G[142]*t591;
    const modeler_lanes t592 = t179*t179;
    const modeler_lanes t593 = x_B6_x*a[0] + x_B6_y*a[1];
    const modeler_lanes t594 = evra_geo_g*t[27] - t[26]*t593;
    MODELER_PUT(78) = t191*t592 + t189*t591 + G[16]*t594;
    MODELER_PUT(167) = t199*t592 + t197*t591 + G[34]*t594;
    MODELER_PUT(255) = G[52]*t594;
    MODELER_PUT(343) = G[70]*t594;
    MODELER_PUT(431) = G[88]*t594;
    MODELER_PUT(519) = G[106]*t594;
    MODELER_PUT(607) = G[124]*t594;
    MODELER_PUT(695) = G[142]*t594;
    const modeler_lanes t595 = t191*t591 - t189*t592;
    const modeler_lanes t596 = t[27]*t593 + evra_geo_g*t[26];
    MODELER_PUT(79) = G[16]*t596 - t595;
    const modeler_lanes t597 = t199*t591 - t197*t592;
    MODELER_PUT(168) = G[34]*t596 - t597;
    MODELER_PUT(256) = G[52]*t596;
    MODELER_PUT(344) = G[70]*t596;
    MODELER_PUT(432) = G[88]*t596;
    MODELER_PUT(520) = G[106]*t596;
    MODELER_PUT(608) = G[124]*t596;
    MODELER_PUT(696) = G[142]*t596;
    const modeler_lanes t598 = t[28]*t591;
    const modeler_lanes t599 = t[29]*t179;
    const modeler_lanes t600 = t182*t599;
    const modeler_lanes t601 = t598 + t600;
    const modeler_lanes t602 = t[28]*t179;
    const modeler_lanes t603 = t182*t602;
    const modeler_lanes t604 = t[28]*t601 + t[29]*t603;
    const modeler_lanes t605 = t602*t599;
    MODELER_PUT(80) = G[17]*t605 - G[16]*t604;
    MODELER_PUT(169) = G[35]*t605 - G[34]*t604;
    MODELER_PUT(257) = G[53]*t605 - G[52]*t604;
    MODELER_PUT(345) = G[71]*t605 - G[70]*t604;
    MODELER_PUT(433) = G[89]*t605 - G[88]*t604;
    MODELER_PUT(521) = G[107]*t605 - G[106]*t604;
    MODELER_PUT(609) = G[125]*t605 - G[124]*t604;
    MODELER_PUT(697) = G[143]*t605 - G[142]*t604;
    const modeler_lanes t606 = t[29]*t591;
    const modeler_lanes t607 = t603 - t606 + t603;
    const modeler_lanes t608 = t600 + t601;
    const modeler_lanes t609 = t[28]*t607 - t[29]*t608;
    const modeler_lanes t610 = t182*t182;
    const modeler_lanes t611 = t599*t599 + t610;
    const modeler_lanes t612 = t602*t602 + t610;
    const modeler_lanes t613 = t611 - t612;
    MODELER_PUT(81) = -(G[16]*t609 + G[17]*t613);
    MODELER_PUT(170) = -(G[34]*t609 + G[35]*t613);
    MODELER_PUT(258) = -(G[52]*t609 + G[53]*t613);
    MODELER_PUT(346) = -(G[70]*t609 + G[71]*t613);
    MODELER_PUT(434) = -(G[88]*t609 + G[89]*t613);
    MODELER_PUT(522) = -(G[106]*t609 + G[107]*t613);
    MODELER_PUT(610) = -(G[124]*t609 + G[125]*t613);
    MODELER_PUT(698) = -(G[142]*t609 + G[143]*t613);
    const modeler_lanes t614 = G[17]*a[0] + G[35]*a[1] + G[53]*a[2] + G[71]*a[3] + G[89]*a[4];
    const modeler_lanes t615 = t588 - (t614 + G[107]*a[5] + G[125]*a[6] + G[143]*a[7]);
    const modeler_lanes t616 = t615 + t605;
    const modeler_lanes t617 = t[28]*t616 - t[29]*(t592 - t611);
    MODELER_PUT(82) = -(G[16]*t617 + G[17]*t598);
    MODELER_PUT(171) = -(G[34]*t617 + G[35]*t598);
    MODELER_PUT(259) = -(G[52]*t617 + G[53]*t598);
    MODELER_PUT(347) = -(G[70]*t617 + G[71]*t598);
    MODELER_PUT(435) = -(G[88]*t617 + G[89]*t598);
    MODELER_PUT(523) = -(G[106]*t617 + G[107]*t598);
    MODELER_PUT(611) = -(G[124]*t617 + G[125]*t598);
    MODELER_PUT(699) = -(G[142]*t617 + G[143]*t598);
    const modeler_lanes t618 = t615 - t605;
    const modeler_lanes t619 = t[28]*(t592 - t612) + t[29]*t618;
    MODELER_PUT(83) = G[16]*t619 + G[17]*t606;
    MODELER_PUT(172) = G[34]*t619 + G[35]*t606;
    MODELER_PUT(260) = G[52]*t619 + G[53]*t606;
    MODELER_PUT(348) = G[70]*t619 + G[71]*t606;
    MODELER_PUT(436) = G[88]*t619 + G[89]*t606;
    MODELER_PUT(524) = G[106]*t619 + G[107]*t606;
    MODELER_PUT(612) = G[124]*t619 + G[125]*t606;
    MODELER_PUT(700) = G[142]*t619 + G[143]*t606;
    MODELER_PUT(84) = -G[17]*t615;
    MODELER_PUT(173) = -G[35]*t615;
    MODELER_PUT(261) = -G[53]*t615;
    MODELER_PUT(349) = -G[71]*t615;
    MODELER_PUT(437) = -G[89]*t615;
    MODELER_PUT(525) = -G[107]*t615;
    MODELER_PUT(613) = -G[125]*t615;
    MODELER_PUT(701) = -G[143]*t615;
    const modeler_lanes t620 = x_B6_y*t[29] + t[28]*t191;
    const modeler_lanes t621 = t192*t611 + t620*t616 - t189*t607;
    const modeler_lanes t622 = t[29]*t594;
    const modeler_lanes t623 = x_B6_x*a[1] - x_B6_y*a[0];
    const modeler_lanes t624 = t[29]*t623 - t[28]*t596;
    MODELER_PUT(85) = -(t621 + G[16]*t622 + G[17]*t624);
    const modeler_lanes t625 = x_B6_x*t[29] - t[28]*t199;
    const modeler_lanes t626 = t200*t611 - t625*t616 - t197*t607;
    MODELER_PUT(174) = -(t626 + G[34]*t622 + G[35]*t624);
    MODELER_PUT(262) = -(G[52]*t622 + G[53]*t624);
    MODELER_PUT(350) = -(G[70]*t622 + G[71]*t624);
    MODELER_PUT(438) = -(G[88]*t622 + G[89]*t624);
    MODELER_PUT(526) = -(G[106]*t622 + G[107]*t624);
    MODELER_PUT(614) = -(G[124]*t622 + G[125]*t624);
    MODELER_PUT(702) = -(G[142]*t622 + G[143]*t624);
    const modeler_lanes t627 = t192*t618 - t620*t612 - t189*t608;
    const modeler_lanes t628 = t[28]*t594;
    const modeler_lanes t629 = t[29]*t596 + t[28]*t623;
    MODELER_PUT(86) = t627 - G[16]*t628 - G[17]*t629;
    const modeler_lanes t630 = t200*t618 + t625*t612 - t197*t608;
    MODELER_PUT(175) = t630 - G[34]*t628 - G[35]*t629;
    MODELER_PUT(263) = -(G[52]*t628 + G[53]*t629);
    MODELER_PUT(351) = -(G[70]*t628 + G[71]*t629);
    MODELER_PUT(439) = -(G[88]*t628 + G[89]*t629);
    MODELER_PUT(527) = -(G[106]*t628 + G[107]*t629);
    MODELER_PUT(615) = -(G[124]*t628 + G[125]*t629);
    MODELER_PUT(703) = -(G[142]*t628 + G[143]*t629);
    const modeler_lanes t631 = t594 - q[25]*t608 + v[7]*t602*2.0;
    const modeler_lanes t632 = q[25]*t[28];
    const modeler_lanes t633 = t[29]*t631 + t607*t632;
    const modeler_lanes t634 = t624 - q[25]*t612 + a[7];
    const modeler_lanes t635 = t634 + q[25]*t611;
    MODELER_PUT(87) = -(t621 + G[16]*t633 + G[17]*t635);
    MODELER_PUT(176) = -(t626 + G[34]*t633 + G[35]*t635);
    MODELER_PUT(264) = -(G[52]*t633 + G[53]*t635);
    MODELER_PUT(352) = -(G[70]*t633 + G[71]*t635);
    MODELER_PUT(440) = -(G[88]*t633 + G[89]*t635);
    MODELER_PUT(528) = -(G[106]*t633 + G[107]*t635);
    MODELER_PUT(616) = -(G[124]*t633 + G[125]*t635);
    MODELER_PUT(704) = t616 - (G[142]*t633 + G[143]*t635);
    const modeler_lanes t636 = q[25]*t618;
    const modeler_lanes t637 = t629 - t636 + v[7]*t182*2.0;
    const modeler_lanes t638 = t[28]*t634 - t[29]*t637 + t592*t632;
    const modeler_lanes t639 = q[25]*t606;
    MODELER_PUT(88) = t595 + G[16]*t638 + G[17]*t639;
    MODELER_PUT(177) = t597 + G[34]*t638 + G[35]*t639;
    MODELER_PUT(265) = G[52]*t638 + G[53]*t639;
    MODELER_PUT(353) = G[70]*t638 + G[71]*t639;
    MODELER_PUT(441) = G[88]*t638 + G[89]*t639;
    MODELER_PUT(529) = G[106]*t638 + G[107]*t639;
    MODELER_PUT(617) = G[124]*t638 + G[125]*t639;
    MODELER_PUT(705) = G[142]*t638 + G[143]*t639 - t598;
    const modeler_lanes t640 = t[28]*t631 - t608*t632;
    const modeler_lanes t641 = t636 - t637;
    MODELER_PUT(89) = -(t627 - G[16]*t640 + G[17]*t641);
    MODELER_PUT(178) = -(t630 - G[34]*t640 + G[35]*t641);
    MODELER_PUT(266) = G[52]*t640 - G[53]*t641;
    MODELER_PUT(354) = G[70]*t640 - G[71]*t641;
    MODELER_PUT(442) = G[88]*t640 - G[89]*t641;
    MODELER_PUT(530) = G[106]*t640 - G[107]*t641;
    MODELER_PUT(618) = G[124]*t640 - G[125]*t641;
    MODELER_PUT(706) = G[142]*t640 - G[143]*t641 - t612;
}

#include "modeler_closing.h"

#ifndef ONE_BY_ONE
#define ONE_BY_ONE

typedef struct {
    int anchored; /* tiles can start from `from` */
    int posed;    /* p is the last posture, and `from` is not later */
    modeler_anchor from;
    struct evra_posture p;
    double rows[UNKNOWNS * EVRA_BASE_PARAMETERS], phi[GIVEN * EVRA_BASE_PARAMETERS];
} closing_state;

/* Samples one after another, from the posture of the last one. */
static void one_by_one(const struct evra_single *one, const double *q, const double *qd, const double *qdd,
                       size_t samples, closing_state *state, double *values, int *status)
{
    const modeler_closure *const loops = one->loops;
    modeler_anchor *const from = &state->from;
    const double *f, *lu, *G;
    int next = state->posed;

    if (state->anchored && !next) {
        double at[GIVEN];

        for (int j = 0; j < GIVEN; j++) {
            at[j] = from->u[loops->given_places[j]];
        }
        next = one->posed(loops, at, from->u, &state->p) == MODELER_CLOSED;
    }
    for (size_t i = 0; i < samples; i++) {
        status[i] = one->next(q + i * GIVEN, qd + i * GIVEN, qdd + i * GIVEN, next, &state->p,
                              state->rows, state->phi);
        next = status[i] == MODELER_CLOSED;
        for (size_t k = 0; k < ENTRIES; k++) {
            values[k * MODELER_LANES + i] = state->phi[row[k] * EVRA_BASE_PARAMETERS + column[k]];
        }
    }
    state->posed = next;
    state->anchored = 0;
    if (next != 0) {
        const modeler_work work = {&state->p.kept, state->p.places, state->p.numbers, 0};

        state->anchored = one->eliminated(loops, &work, &f, &lu, &G);
    }
    if (state->anchored != 0) {
        memset(from, 0, sizeof *from);
        memcpy(from->u, state->p.u, sizeof from->u);
        memcpy(from->J, f + JACOBIAN_AT, sizeof from->J);
        memcpy(from->lu, lu, sizeof from->lu);
        memcpy(from->G, G, sizeof from->G);
        for (int k = 0; k < UNKNOWNS; k++) {
            from->share[k] = 1 / loops->scale[k];
        }
    }
}

#endif

/* MODELER_WIDTH samples together; 0, and nothing done, where that is not safe. */
MODELER_TARGET static int MODELER_VERSION(vector)(const modeler_closure *loops,
                                                  const double *q, const double *qd,
                                                  const double *qdd, modeler_anchor *from,
                                                  double *values)
{
    const modeler_lanes given[] = {
        MODELER_ROWS(q, 8, 0),
        MODELER_ROWS(q, 8, 1),
        MODELER_ROWS(q, 8, 2),
        MODELER_ROWS(q, 8, 3),
        MODELER_ROWS(q, 8, 4),
        MODELER_ROWS(q, 8, 5),
        MODELER_ROWS(q, 8, 6),
        MODELER_ROWS(q, 8, 7),
    };
    const modeler_lanes v[] = {
        MODELER_ROWS(qd, 8, 0),
        MODELER_ROWS(qd, 8, 1),
        MODELER_ROWS(qd, 8, 2),
        MODELER_ROWS(qd, 8, 3),
        MODELER_ROWS(qd, 8, 4),
        MODELER_ROWS(qd, 8, 5),
        MODELER_ROWS(qd, 8, 6),
        MODELER_ROWS(qd, 8, 7),
    };
    const modeler_lanes a[] = {
        MODELER_ROWS(qdd, 8, 0),
        MODELER_ROWS(qdd, 8, 1),
        MODELER_ROWS(qdd, 8, 2),
        MODELER_ROWS(qdd, 8, 3),
        MODELER_ROWS(qdd, 8, 4),
        MODELER_ROWS(qdd, 8, 5),
        MODELER_ROWS(qdd, 8, 6),
        MODELER_ROWS(qdd, 8, 7),
    };
    modeler_lanes u[UNKNOWNS], f[LENGTH], lu[FACTORS], G[COUPLINGS];

    if (!MODELER_VERSION(together)(loops, from, given, v, a, u, f, lu)) {
        return 0;
    }
    MODELER_VERSION(coupling)(f + JACOBIAN_AT, lu, G);
    MODELER_VERSION(rows)(u, f + TURNS_AT, G, lu, v, a, values);
    for (int j = 0; j < GIVEN; j++) {
        from->last[j] = MODELER_LAST(given[j]) - from->u[loops->given_places[j]];
    }
    for (int k = 0; k < UNKNOWNS; k++) {
        from->u[k] = MODELER_LAST(u[k]);
    }
    for (int k = 0; k < JACOBIAN; k++) {
        from->J[k] = MODELER_LAST(f[JACOBIAN_AT + k]);
    }
    for (int k = 0; k < FACTORS; k++) {
        from->lu[k] = MODELER_LAST(lu[k]);
    }
    for (int k = 0; k < COUPLINGS; k++) {
        from->turned[k] = MODELER_LAST(G[k]) - from->G[k];
        from->G[k] = MODELER_LAST(G[k]);
    }
    return 1;
}

static void MODELER_VERSION(closing)(const modeler_tiled *robot, const double *q, const double *qd,
                                     const double *qdd, size_t samples, void *memory,
                                     double *values, int *status)
{
    const struct evra_single *const one = (const struct evra_single *)robot->singles;
    closing_state *const state = (closing_state *)memory;

    for (size_t i = 0; i < samples; i += MODELER_WIDTH) {
        const size_t now = samples - i < MODELER_WIDTH ? samples - i : MODELER_WIDTH;

        size_t done = 0;

        if (!state->anchored) {
            one_by_one(one, q, qd, qdd, 1, state, values + i, status + i);
            done = 1;
        }
        if (state->anchored && MODELER_VERSION(vector)(one->loops, q, qd, qdd, &state->from, values + i)) {
            state->posed = 0;
            for (size_t k = 0; k < now; k++) {
                status[i + k] = MODELER_CLOSED;
            }
        } else if (done < now) {
            one_by_one(one, q + done * GIVEN, qd + done * GIVEN, qdd + done * GIVEN, now - done, state,
                       values + i + done, status + i + done);
        }
        q += MODELER_WIDTH * GIVEN;
        qd += MODELER_WIDTH * GIVEN;
        qdd += MODELER_WIDTH * GIVEN;
    }
}

#endif
