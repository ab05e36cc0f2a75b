/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * SPDX-License-Identifier: MIT
 *
 * Dynamic model, linear in its parameters: tau = M(q) qdd + c(q, qd) + g(q) + f(qd) = phi beta.
 * C99, no dependency but <math.h>, no allocation, no global state, re-entrant.
 *
 * Joints, in the order of q, qd, qdd, tau: 11, 12, 13.
 * SI units. Matrices are row-major. Outputs must not overlap inputs.
 *
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef ORTHOGLIDE_2003_H
#define ORTHOGLIDE_2003_H

#include <stddef.h>

#include "modeler_kept.h"
#include "modeler_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What orthoglide_2003_signature() of the library that belongs to this header returns. */
#define ORTHOGLIDE_2003_SIGNATURE "8b4d899ee4120f16"
#define ORTHOGLIDE_2003_SIGNATURE_1 0x8b4d899eu
#define ORTHOGLIDE_2003_SIGNATURE_2 0xe4120f16u

/* Of the calls: raised when one takes other arguments. Which version of modeler wrote the folder
 * stands in orthoglide_2003_generator.h. */
#define ORTHOGLIDE_2003_INTERFACE 2
#define ORTHOGLIDE_2003_LICENSE "MIT"

#define ORTHOGLIDE_2003_JOINTS 3
#define ORTHOGLIDE_2003_STANDARD_PARAMETERS 163
#define ORTHOGLIDE_2003_BASE_PARAMETERS 43
#define ORTHOGLIDE_2003_FREE_VARIABLES 12
#ifndef ORTHOGLIDE_2003_MAX_CLOSURE_EVALUATIONS
#define ORTHOGLIDE_2003_MAX_CLOSURE_EVALUATIONS 5000 /* in one call; -D sets another, in all files alike */
#endif

/* chi: standard parameters, columns of orthoglide_2003_regressor
 *
 *    0  MP       kg
 *    1  XX11     kg m2
 *    2  XY11     kg m2
 *    3  XZ11     kg m2
 *    4  YY11     kg m2
 *    5  YZ11     kg m2
 *    6  ZZ11     kg m2
 *    7  MX11     kg m
 *    8  MY11     kg m
 *    9  MZ11     kg m
 *   10  M11      kg
 *   11  Ia11     kg
 *   12  Fv11     N s/m
 *   13  Fs11     N
 *   14  Off11    N
 *   15  XX12     kg m2
 *   16  XY12     kg m2
 *   17  XZ12     kg m2
 *   18  YY12     kg m2
 *   19  YZ12     kg m2
 *   20  ZZ12     kg m2
 *   21  MX12     kg m
 *   22  MY12     kg m
 *   23  MZ12     kg m
 *   24  M12      kg
 *   25  Ia12     kg
 *   26  Fv12     N s/m
 *   27  Fs12     N
 *   28  Off12    N
 *   29  XX13     kg m2
 *   30  XY13     kg m2
 *   31  XZ13     kg m2
 *   32  YY13     kg m2
 *   33  YZ13     kg m2
 *   34  ZZ13     kg m2
 *   35  MX13     kg m
 *   36  MY13     kg m
 *   37  MZ13     kg m
 *   38  M13      kg
 *   39  Ia13     kg
 *   40  Fv13     N s/m
 *   41  Fs13     N
 *   42  Off13    N
 *   43  XX21     kg m2
 *   44  XY21     kg m2
 *   45  XZ21     kg m2
 *   46  YY21     kg m2
 *   47  YZ21     kg m2
 *   48  ZZ21     kg m2
 *   49  MX21     kg m
 *   50  MY21     kg m
 *   51  MZ21     kg m
 *   52  M21      kg
 *   53  XX31     kg m2
 *   54  XY31     kg m2
 *   55  XZ31     kg m2
 *   56  YY31     kg m2
 *   57  YZ31     kg m2
 *   58  ZZ31     kg m2
 *   59  MX31     kg m
 *   60  MY31     kg m
 *   61  MZ31     kg m
 *   62  M31      kg
 *   63  XX41     kg m2
 *   64  XY41     kg m2
 *   65  XZ41     kg m2
 *   66  YY41     kg m2
 *   67  YZ41     kg m2
 *   68  ZZ41     kg m2
 *   69  MX41     kg m
 *   70  MY41     kg m
 *   71  MZ41     kg m
 *   72  M41      kg
 *   73  XX71     kg m2
 *   74  XY71     kg m2
 *   75  XZ71     kg m2
 *   76  YY71     kg m2
 *   77  YZ71     kg m2
 *   78  ZZ71     kg m2
 *   79  MX71     kg m
 *   80  MY71     kg m
 *   81  MZ71     kg m
 *   82  M71      kg
 *   83  XX22     kg m2
 *   84  XY22     kg m2
 *   85  XZ22     kg m2
 *   86  YY22     kg m2
 *   87  YZ22     kg m2
 *   88  ZZ22     kg m2
 *   89  MX22     kg m
 *   90  MY22     kg m
 *   91  MZ22     kg m
 *   92  M22      kg
 *   93  XX32     kg m2
 *   94  XY32     kg m2
 *   95  XZ32     kg m2
 *   96  YY32     kg m2
 *   97  YZ32     kg m2
 *   98  ZZ32     kg m2
 *   99  MX32     kg m
 *  100  MY32     kg m
 *  101  MZ32     kg m
 *  102  M32      kg
 *  103  XX42     kg m2
 *  104  XY42     kg m2
 *  105  XZ42     kg m2
 *  106  YY42     kg m2
 *  107  YZ42     kg m2
 *  108  ZZ42     kg m2
 *  109  MX42     kg m
 *  110  MY42     kg m
 *  111  MZ42     kg m
 *  112  M42      kg
 *  113  XX72     kg m2
 *  114  XY72     kg m2
 *  115  XZ72     kg m2
 *  116  YY72     kg m2
 *  117  YZ72     kg m2
 *  118  ZZ72     kg m2
 *  119  MX72     kg m
 *  120  MY72     kg m
 *  121  MZ72     kg m
 *  122  M72      kg
 *  123  XX23     kg m2
 *  124  XY23     kg m2
 *  125  XZ23     kg m2
 *  126  YY23     kg m2
 *  127  YZ23     kg m2
 *  128  ZZ23     kg m2
 *  129  MX23     kg m
 *  130  MY23     kg m
 *  131  MZ23     kg m
 *  132  M23      kg
 *  133  XX33     kg m2
 *  134  XY33     kg m2
 *  135  XZ33     kg m2
 *  136  YY33     kg m2
 *  137  YZ33     kg m2
 *  138  ZZ33     kg m2
 *  139  MX33     kg m
 *  140  MY33     kg m
 *  141  MZ33     kg m
 *  142  M33      kg
 *  143  XX43     kg m2
 *  144  XY43     kg m2
 *  145  XZ43     kg m2
 *  146  YY43     kg m2
 *  147  YZ43     kg m2
 *  148  ZZ43     kg m2
 *  149  MX43     kg m
 *  150  MY43     kg m
 *  151  MZ43     kg m
 *  152  M43      kg
 *  153  XX73     kg m2
 *  154  XY73     kg m2
 *  155  XZ73     kg m2
 *  156  YY73     kg m2
 *  157  YZ73     kg m2
 *  158  ZZ73     kg m2
 *  159  MX73     kg m
 *  160  MY73     kg m
 *  161  MZ73     kg m
 *  162  M73      kg
 */
enum {
    ORTHOGLIDE_2003_CHI_MP, ORTHOGLIDE_2003_CHI_XX11, ORTHOGLIDE_2003_CHI_XY11,
    ORTHOGLIDE_2003_CHI_XZ11, ORTHOGLIDE_2003_CHI_YY11, ORTHOGLIDE_2003_CHI_YZ11,
    ORTHOGLIDE_2003_CHI_ZZ11, ORTHOGLIDE_2003_CHI_MX11, ORTHOGLIDE_2003_CHI_MY11,
    ORTHOGLIDE_2003_CHI_MZ11, ORTHOGLIDE_2003_CHI_M11, ORTHOGLIDE_2003_CHI_Ia11,
    ORTHOGLIDE_2003_CHI_Fv11, ORTHOGLIDE_2003_CHI_Fs11, ORTHOGLIDE_2003_CHI_Off11,
    ORTHOGLIDE_2003_CHI_XX12, ORTHOGLIDE_2003_CHI_XY12, ORTHOGLIDE_2003_CHI_XZ12,
    ORTHOGLIDE_2003_CHI_YY12, ORTHOGLIDE_2003_CHI_YZ12, ORTHOGLIDE_2003_CHI_ZZ12,
    ORTHOGLIDE_2003_CHI_MX12, ORTHOGLIDE_2003_CHI_MY12, ORTHOGLIDE_2003_CHI_MZ12,
    ORTHOGLIDE_2003_CHI_M12, ORTHOGLIDE_2003_CHI_Ia12, ORTHOGLIDE_2003_CHI_Fv12,
    ORTHOGLIDE_2003_CHI_Fs12, ORTHOGLIDE_2003_CHI_Off12, ORTHOGLIDE_2003_CHI_XX13,
    ORTHOGLIDE_2003_CHI_XY13, ORTHOGLIDE_2003_CHI_XZ13, ORTHOGLIDE_2003_CHI_YY13,
    ORTHOGLIDE_2003_CHI_YZ13, ORTHOGLIDE_2003_CHI_ZZ13, ORTHOGLIDE_2003_CHI_MX13,
    ORTHOGLIDE_2003_CHI_MY13, ORTHOGLIDE_2003_CHI_MZ13, ORTHOGLIDE_2003_CHI_M13,
    ORTHOGLIDE_2003_CHI_Ia13, ORTHOGLIDE_2003_CHI_Fv13, ORTHOGLIDE_2003_CHI_Fs13,
    ORTHOGLIDE_2003_CHI_Off13, ORTHOGLIDE_2003_CHI_XX21, ORTHOGLIDE_2003_CHI_XY21,
    ORTHOGLIDE_2003_CHI_XZ21, ORTHOGLIDE_2003_CHI_YY21, ORTHOGLIDE_2003_CHI_YZ21,
    ORTHOGLIDE_2003_CHI_ZZ21, ORTHOGLIDE_2003_CHI_MX21, ORTHOGLIDE_2003_CHI_MY21,
    ORTHOGLIDE_2003_CHI_MZ21, ORTHOGLIDE_2003_CHI_M21, ORTHOGLIDE_2003_CHI_XX31,
    ORTHOGLIDE_2003_CHI_XY31, ORTHOGLIDE_2003_CHI_XZ31, ORTHOGLIDE_2003_CHI_YY31,
    ORTHOGLIDE_2003_CHI_YZ31, ORTHOGLIDE_2003_CHI_ZZ31, ORTHOGLIDE_2003_CHI_MX31,
    ORTHOGLIDE_2003_CHI_MY31, ORTHOGLIDE_2003_CHI_MZ31, ORTHOGLIDE_2003_CHI_M31,
    ORTHOGLIDE_2003_CHI_XX41, ORTHOGLIDE_2003_CHI_XY41, ORTHOGLIDE_2003_CHI_XZ41,
    ORTHOGLIDE_2003_CHI_YY41, ORTHOGLIDE_2003_CHI_YZ41, ORTHOGLIDE_2003_CHI_ZZ41,
    ORTHOGLIDE_2003_CHI_MX41, ORTHOGLIDE_2003_CHI_MY41, ORTHOGLIDE_2003_CHI_MZ41,
    ORTHOGLIDE_2003_CHI_M41, ORTHOGLIDE_2003_CHI_XX71, ORTHOGLIDE_2003_CHI_XY71,
    ORTHOGLIDE_2003_CHI_XZ71, ORTHOGLIDE_2003_CHI_YY71, ORTHOGLIDE_2003_CHI_YZ71,
    ORTHOGLIDE_2003_CHI_ZZ71, ORTHOGLIDE_2003_CHI_MX71, ORTHOGLIDE_2003_CHI_MY71,
    ORTHOGLIDE_2003_CHI_MZ71, ORTHOGLIDE_2003_CHI_M71, ORTHOGLIDE_2003_CHI_XX22,
    ORTHOGLIDE_2003_CHI_XY22, ORTHOGLIDE_2003_CHI_XZ22, ORTHOGLIDE_2003_CHI_YY22,
    ORTHOGLIDE_2003_CHI_YZ22, ORTHOGLIDE_2003_CHI_ZZ22, ORTHOGLIDE_2003_CHI_MX22,
    ORTHOGLIDE_2003_CHI_MY22, ORTHOGLIDE_2003_CHI_MZ22, ORTHOGLIDE_2003_CHI_M22,
    ORTHOGLIDE_2003_CHI_XX32, ORTHOGLIDE_2003_CHI_XY32, ORTHOGLIDE_2003_CHI_XZ32,
    ORTHOGLIDE_2003_CHI_YY32, ORTHOGLIDE_2003_CHI_YZ32, ORTHOGLIDE_2003_CHI_ZZ32,
    ORTHOGLIDE_2003_CHI_MX32, ORTHOGLIDE_2003_CHI_MY32, ORTHOGLIDE_2003_CHI_MZ32,
    ORTHOGLIDE_2003_CHI_M32, ORTHOGLIDE_2003_CHI_XX42, ORTHOGLIDE_2003_CHI_XY42,
    ORTHOGLIDE_2003_CHI_XZ42, ORTHOGLIDE_2003_CHI_YY42, ORTHOGLIDE_2003_CHI_YZ42,
    ORTHOGLIDE_2003_CHI_ZZ42, ORTHOGLIDE_2003_CHI_MX42, ORTHOGLIDE_2003_CHI_MY42,
    ORTHOGLIDE_2003_CHI_MZ42, ORTHOGLIDE_2003_CHI_M42, ORTHOGLIDE_2003_CHI_XX72,
    ORTHOGLIDE_2003_CHI_XY72, ORTHOGLIDE_2003_CHI_XZ72, ORTHOGLIDE_2003_CHI_YY72,
    ORTHOGLIDE_2003_CHI_YZ72, ORTHOGLIDE_2003_CHI_ZZ72, ORTHOGLIDE_2003_CHI_MX72,
    ORTHOGLIDE_2003_CHI_MY72, ORTHOGLIDE_2003_CHI_MZ72, ORTHOGLIDE_2003_CHI_M72,
    ORTHOGLIDE_2003_CHI_XX23, ORTHOGLIDE_2003_CHI_XY23, ORTHOGLIDE_2003_CHI_XZ23,
    ORTHOGLIDE_2003_CHI_YY23, ORTHOGLIDE_2003_CHI_YZ23, ORTHOGLIDE_2003_CHI_ZZ23,
    ORTHOGLIDE_2003_CHI_MX23, ORTHOGLIDE_2003_CHI_MY23, ORTHOGLIDE_2003_CHI_MZ23,
    ORTHOGLIDE_2003_CHI_M23, ORTHOGLIDE_2003_CHI_XX33, ORTHOGLIDE_2003_CHI_XY33,
    ORTHOGLIDE_2003_CHI_XZ33, ORTHOGLIDE_2003_CHI_YY33, ORTHOGLIDE_2003_CHI_YZ33,
    ORTHOGLIDE_2003_CHI_ZZ33, ORTHOGLIDE_2003_CHI_MX33, ORTHOGLIDE_2003_CHI_MY33,
    ORTHOGLIDE_2003_CHI_MZ33, ORTHOGLIDE_2003_CHI_M33, ORTHOGLIDE_2003_CHI_XX43,
    ORTHOGLIDE_2003_CHI_XY43, ORTHOGLIDE_2003_CHI_XZ43, ORTHOGLIDE_2003_CHI_YY43,
    ORTHOGLIDE_2003_CHI_YZ43, ORTHOGLIDE_2003_CHI_ZZ43, ORTHOGLIDE_2003_CHI_MX43,
    ORTHOGLIDE_2003_CHI_MY43, ORTHOGLIDE_2003_CHI_MZ43, ORTHOGLIDE_2003_CHI_M43,
    ORTHOGLIDE_2003_CHI_XX73, ORTHOGLIDE_2003_CHI_XY73, ORTHOGLIDE_2003_CHI_XZ73,
    ORTHOGLIDE_2003_CHI_YY73, ORTHOGLIDE_2003_CHI_YZ73, ORTHOGLIDE_2003_CHI_ZZ73,
    ORTHOGLIDE_2003_CHI_MX73, ORTHOGLIDE_2003_CHI_MY73, ORTHOGLIDE_2003_CHI_MZ73,
    ORTHOGLIDE_2003_CHI_M73
};

/* beta: base parameters, columns of orthoglide_2003_base_regressor
 *
 *    0  MPR = MP + MX31/D41 + M41 + MX71/D41 + MX32/D42 + M42 + MX72/D42 + MX33/D43 + M43 +
 *         MX73/D43  [kg]
 *    1  Ia11R = Ia11 + M11 + M21 - MX31/D41 + M31 - MX71/D41 + M71  [kg]
 *    2  Fv11  [N s/m]
 *    3  Fs11  [N]
 *    4  Off11  [N]
 *    5  Ia12R = Ia12 + M12 + M22 - MX32/D42 + M32 - MX72/D42 + M72  [kg]
 *    6  Fv12  [N s/m]
 *    7  Fs12  [N]
 *    8  Off12  [N]
 *    9  Ia13R = Ia13 + M13 + M23 - MX33/D43 + M33 - MX73/D43 + M73  [kg]
 *   10  Fv13  [N s/m]
 *   11  Fs13  [N]
 *   12  Off13R = Off13 - g*M13 - g*M23 + g*MX33/D43 - g*M33 + g*MX73/D43 - g*M73  [N]
 *   13  ZZ21R = ZZ21 + YY31 - D41*MX31 + YY41 + YY71 - D41*MX71  [kg m2]
 *   14  MX21  [kg m]
 *   15  MY21R = MY21 + MZ31 + MZ41 + MZ71  [kg m]
 *   16  XX31R = XX31 - YY31 + D41*MX31 + XX71 - YY71 + D41*MX71  [kg m2]
 *   17  XY31R = XY31 + XY71  [kg m2]
 *   18  XZ31R = XZ31 - D41*MZ41 + XZ71  [kg m2]
 *   19  YZ31R = YZ31 + YZ71  [kg m2]
 *   20  ZZ31R = ZZ31 - D41*MX31 + ZZ71 - D41*MX71  [kg m2]
 *   21  MY31R = MY31 + MY71  [kg m]
 *   22  MX41  [kg m]
 *   23  ZZ22R = ZZ22 + YY32 - D42*MX32 + YY42 + YY72 - D42*MX72  [kg m2]
 *   24  MX22  [kg m]
 *   25  MY22R = MY22 + MZ32 + MZ42 + MZ72  [kg m]
 *   26  XX32R = XX32 - YY32 + D42*MX32 + XX72 - YY72 + D42*MX72  [kg m2]
 *   27  XY32R = XY32 + XY72  [kg m2]
 *   28  XZ32R = XZ32 - D42*MZ42 + XZ72  [kg m2]
 *   29  YZ32R = YZ32 + YZ72  [kg m2]
 *   30  ZZ32R = ZZ32 - D42*MX32 + ZZ72 - D42*MX72  [kg m2]
 *   31  MY32R = MY32 + MY72  [kg m]
 *   32  MX42  [kg m]
 *   33  ZZ23R = ZZ23 + YY33 - D43*MX33 + YY43 + YY73 - D43*MX73  [kg m2]
 *   34  MX23  [kg m]
 *   35  MY23R = MY23 + MZ33 + MZ43 + MZ73  [kg m]
 *   36  XX33R = XX33 - YY33 + D43*MX33 + XX73 - YY73 + D43*MX73  [kg m2]
 *   37  XY33R = XY33 + XY73  [kg m2]
 *   38  XZ33R = XZ33 - D43*MZ43 + XZ73  [kg m2]
 *   39  YZ33R = YZ33 + YZ73  [kg m2]
 *   40  ZZ33R = ZZ33 - D43*MX33 + ZZ73 - D43*MX73  [kg m2]
 *   41  MY33R = MY33 + MY73  [kg m]
 *   42  MX43  [kg m]
 */
enum {
    ORTHOGLIDE_2003_BETA_MPR, ORTHOGLIDE_2003_BETA_Ia11R, ORTHOGLIDE_2003_BETA_Fv11,
    ORTHOGLIDE_2003_BETA_Fs11, ORTHOGLIDE_2003_BETA_Off11, ORTHOGLIDE_2003_BETA_Ia12R,
    ORTHOGLIDE_2003_BETA_Fv12, ORTHOGLIDE_2003_BETA_Fs12, ORTHOGLIDE_2003_BETA_Off12,
    ORTHOGLIDE_2003_BETA_Ia13R, ORTHOGLIDE_2003_BETA_Fv13, ORTHOGLIDE_2003_BETA_Fs13,
    ORTHOGLIDE_2003_BETA_Off13R, ORTHOGLIDE_2003_BETA_ZZ21R, ORTHOGLIDE_2003_BETA_MX21,
    ORTHOGLIDE_2003_BETA_MY21R, ORTHOGLIDE_2003_BETA_XX31R, ORTHOGLIDE_2003_BETA_XY31R,
    ORTHOGLIDE_2003_BETA_XZ31R, ORTHOGLIDE_2003_BETA_YZ31R, ORTHOGLIDE_2003_BETA_ZZ31R,
    ORTHOGLIDE_2003_BETA_MY31R, ORTHOGLIDE_2003_BETA_MX41, ORTHOGLIDE_2003_BETA_ZZ22R,
    ORTHOGLIDE_2003_BETA_MX22, ORTHOGLIDE_2003_BETA_MY22R, ORTHOGLIDE_2003_BETA_XX32R,
    ORTHOGLIDE_2003_BETA_XY32R, ORTHOGLIDE_2003_BETA_XZ32R, ORTHOGLIDE_2003_BETA_YZ32R,
    ORTHOGLIDE_2003_BETA_ZZ32R, ORTHOGLIDE_2003_BETA_MY32R, ORTHOGLIDE_2003_BETA_MX42,
    ORTHOGLIDE_2003_BETA_ZZ23R, ORTHOGLIDE_2003_BETA_MX23, ORTHOGLIDE_2003_BETA_MY23R,
    ORTHOGLIDE_2003_BETA_XX33R, ORTHOGLIDE_2003_BETA_XY33R, ORTHOGLIDE_2003_BETA_XZ33R,
    ORTHOGLIDE_2003_BETA_YZ33R, ORTHOGLIDE_2003_BETA_ZZ33R, ORTHOGLIDE_2003_BETA_MY33R,
    ORTHOGLIDE_2003_BETA_MX43
};

/* u: free variables of the opened tree: Px, Py, P, 11, 12, 13, 21, 31, 22, 32, 23, 33
 *
 * Functions that close the loops return a status: 0 done; 1 the loops cannot be closed on the
 * straight way from the home posture to these values; 2 singular posture; 3 an input is not finite,
 * or an output would not be; 4 these values are so far that ORTHOGLIDE_2003_MAX_CLOSURE_EVALUATIONS
 * evaluations of the closure equations do not do: no call makes more. Outputs are NaN unless it is 0. The assembly
 * mode is that of the home posture.
 */

/* Tells whether this code belongs to a manifest. */
const char *orthoglide_2003_signature(void);

/* Regressor of the standard parameters.
 *
 * tau = phi chi
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * qdd    3        joint accelerations [m/s2]
 * phi    3 x 163  torque per unit of each standard parameter, row-major [SI]
 */
int orthoglide_2003_regressor(const double q[ORTHOGLIDE_2003_JOINTS],
                              const double qd[ORTHOGLIDE_2003_JOINTS],
                              const double qdd[ORTHOGLIDE_2003_JOINTS], double phi[3 * 163]);

/* Regressor of the base parameters.
 *
 * tau = phi beta
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * qdd    3        joint accelerations [m/s2]
 * phi    3 x 43   torque per unit of each base parameter, row-major [SI]
 */
int orthoglide_2003_base_regressor(const double q[ORTHOGLIDE_2003_JOINTS],
                                   const double qd[ORTHOGLIDE_2003_JOINTS],
                                   const double qdd[ORTHOGLIDE_2003_JOINTS], double phi[3 * 43]);

/* Torques that move the closed robot so.
 *
 * tau = M qdd + c + g + f
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * qdd    3        joint accelerations [m/s2]
 * beta   43       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2003_inverse_dynamics(const double q[ORTHOGLIDE_2003_JOINTS],
                                     const double qd[ORTHOGLIDE_2003_JOINTS],
                                     const double qdd[ORTHOGLIDE_2003_JOINTS],
                                     const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                     double tau[ORTHOGLIDE_2003_JOINTS]);

/* Torques that hold the robot still, without friction.
 *
 * g(q) = tau(q, 0, 0) without effects
 *
 * q      3        joint positions [m]
 * beta   43       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2003_gravity(const double q[ORTHOGLIDE_2003_JOINTS],
                            const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                            double tau[ORTHOGLIDE_2003_JOINTS]);

/* Coriolis and centripetal torques.
 *
 * c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * beta   43       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2003_coriolis(const double q[ORTHOGLIDE_2003_JOINTS],
                             const double qd[ORTHOGLIDE_2003_JOINTS],
                             const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                             double tau[ORTHOGLIDE_2003_JOINTS]);

/* Torques of all effects but rotor inertias: friction, offsets.
 *
 * f(q, qd)
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * beta   43       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2003_friction(const double q[ORTHOGLIDE_2003_JOINTS],
                             const double qd[ORTHOGLIDE_2003_JOINTS],
                             const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                             double tau[ORTHOGLIDE_2003_JOINTS]);

/* Inertia matrix, rotor inertias included; symmetric.
 *
 * tau = M(q) qdd + ...
 *
 * q      3        joint positions [m]
 * beta   43       base parameters [SI]
 * M      3 x 3    inertia matrix, row-major [kg m2, kg m or kg]
 */
int orthoglide_2003_inertia_matrix(const double q[ORTHOGLIDE_2003_JOINTS],
                                   const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                   double M[3 * 3]);

/* Pose of the frame of every moving row of the table.
 *
 * x0 = R x + p with T = [R | p], for a point x of the frame
 *
 * q      3          joint positions [m]
 * T      21 x 3 x 4 poses [R | p] of rows Px, Py, P, 11, 12, 13, 21, 31, 41, 51, 71, 22, 32, 42,
 *                   52, 72, 23, 33, 43, 53, 73 in frame 0, row-major [1 | m]
 */
int orthoglide_2003_forward_kinematics(const double q[ORTHOGLIDE_2003_JOINTS],
                                       double T[21 * 3 * 4]);

/* Closed posture, on a straight way from home.
 *
 * f(u) = 0
 *
 * q      3        joint positions [m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2003_close(const double q[ORTHOGLIDE_2003_JOINTS], double u[12]);

/* Closed posture, on a straight way from another one, such as the last.
 *
 * f(u) = 0
 *
 * q      3        joint positions [m]
 * start  12       a closed posture to start from [rad or m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2003_close_from(const double q[ORTHOGLIDE_2003_JOINTS], const double start[12],
                               double u[12]);

/* Speeds of the free variables; rows of the platform are its Jacobian.
 *
 * ud = G qd
 *
 * q      3        joint positions [m]
 * G      12 x 3   d u / d q, row-major [SI]
 */
int orthoglide_2003_coupling(const double q[ORTHOGLIDE_2003_JOINTS], double G[12 * 3]);

/* Base parameters from standard ones: the grouping relations.
 *
 * beta = K chi
 *
 * chi    163      standard parameters [SI]
 * beta   43       base parameters [SI]
 */
void orthoglide_2003_base_parameters(const double chi[ORTHOGLIDE_2003_STANDARD_PARAMETERS],
                                     double beta[ORTHOGLIDE_2003_BASE_PARAMETERS]);

/* Regressor of the base parameters.
 *
 * f = phi beta
 *
 * x      3        positions of the platform: Px, Py, P [m]
 * xd     3        their velocities [m/s]
 * xdd    3        their accelerations [m/s2]
 * phi    3 x 43   torque per unit of each base parameter, row-major [SI]
 */
int orthoglide_2003_platform_base_regressor(const double x[3], const double xd[3],
                                            const double xdd[3], double phi[3 * 43]);

/* Torques that move the closed robot so.
 *
 * f = M xdd + c + g + f
 *
 * x      3        positions of the platform: Px, Py, P [m]
 * xd     3        their velocities [m/s]
 * xdd    3        their accelerations [m/s2]
 * beta   43       base parameters [SI]
 * f      3        forces and torques along x [N]
 */
int orthoglide_2003_platform_inverse_dynamics(const double x[3], const double xd[3],
                                              const double xdd[3],
                                              const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                              double f[3]);

/* Closed posture, on a straight way from home.
 *
 * f(u) = 0
 *
 * x      3        positions of the platform: Px, Py, P [m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2003_platform_close(const double x[3], double u[12]);

/* Closed posture, on a straight way from another one, such as the last.
 *
 * f(u) = 0
 *
 * x      3        positions of the platform: Px, Py, P [m]
 * start  12       a closed posture to start from [rad or m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2003_platform_close_from(const double x[3], const double start[12], double u[12]);

/* Speeds of the free variables; rows of the platform are its Jacobian.
 *
 * ud = G xd
 *
 * x      3        positions of the platform: Px, Py, P [m]
 * G      12 x 3   d u / d x, row-major [SI]
 */
int orthoglide_2003_platform_coupling(const double x[3], double G[12 * 3]);

/* A closed posture and what solved it, and a controller's state: members are the library's. */
struct orthoglide_2003_posture {
    double u[12];      /* free variables */
    double ud[12];     /* their speeds */
    double gamma[12];  /* their accelerations at qdd = 0 */
    double G[36];
    double qd[3];
    modeler_kept kept;
    int places[30];
    double numbers[458];
};

struct orthoglide_2003_state {
    struct orthoglide_2003_posture at;
    int closed; /* by the last call of orthoglide_2003_state; memory of zeros is no state yet */
    int status;
    int rated; /* `rate` holds dG/dt */
    double rate[36];
    double rows[516];
};

/* The state at q, qd: closes the loops once for all functions that end in _at.
 *
 * They are those of the same name without q and qd, and give the same numbers. The loops are closed
 * from the closed posture `previous`; NULL: from home, as at the start. In a control loop give the
 * state's own last one, state.at.u (from home, if there is none yet): at 1 kHz that takes two or three evaluations of the closure
 * equations. Returns a status. Unless it is 0, the functions return it too, with outputs NaN, and
 * the posture is the last closed one, from where the next call may go on. Before the first status 0
 * there is none: give NULL, and call no function that ends in _at.
 */
#if defined(__cplusplus) && defined(__GNUC__) /* a structure and a function of one name */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#endif
int orthoglide_2003_state(const double *q, const double *qd, const double *previous,
    struct orthoglide_2003_state *state);

/* The same with at most `evaluations` of the closure equations, and never more than
 * ORTHOGLIDE_2003_MAX_CLOSURE_EVALUATIONS: status 4 if these do not do. */
int orthoglide_2003_state_with_bound(const double *q, const double *qd, const double *previous,
    int evaluations, struct orthoglide_2003_state *state);
#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
int orthoglide_2003_base_regressor_at(struct orthoglide_2003_state *state,
                                      const double qdd[ORTHOGLIDE_2003_JOINTS], double phi[3 * 43]);
int orthoglide_2003_inverse_dynamics_at(struct orthoglide_2003_state *state,
                                        const double qdd[ORTHOGLIDE_2003_JOINTS],
                                        const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                        double tau[ORTHOGLIDE_2003_JOINTS]);
int orthoglide_2003_gravity_at(struct orthoglide_2003_state *state,
                               const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                               double tau[ORTHOGLIDE_2003_JOINTS]);
int orthoglide_2003_coriolis_at(struct orthoglide_2003_state *state,
                                const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                double tau[ORTHOGLIDE_2003_JOINTS]);
int orthoglide_2003_friction_at(struct orthoglide_2003_state *state,
                                const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                double tau[ORTHOGLIDE_2003_JOINTS]);
int orthoglide_2003_inertia_matrix_at(struct orthoglide_2003_state *state,
                                      const double beta[ORTHOGLIDE_2003_BASE_PARAMETERS],
                                      double M[3 * 3]);
int orthoglide_2003_forward_kinematics_at(struct orthoglide_2003_state *state,
                                          double T[21 * 3 * 4]);
int orthoglide_2003_coupling_at(struct orthoglide_2003_state *state, double G[12 * 3]);

/* dG/dt, as G: udd = G qdd + dG/dt qd. `rate` may be NULL: it is kept in the state. */
int orthoglide_2003_coupling_rate_at(struct orthoglide_2003_state *state, double *rate);

#ifdef __cplusplus
}
#endif

#endif
