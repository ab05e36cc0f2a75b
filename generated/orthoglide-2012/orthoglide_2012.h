/* Orthoglide, full dynamic model (Briot, Gautier 2012)
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
#ifndef ORTHOGLIDE_2012_H
#define ORTHOGLIDE_2012_H

#include <stddef.h>

#include "modeler_kept.h"
#include "modeler_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What orthoglide_2012_signature() of the library that belongs to this header returns. */
#define ORTHOGLIDE_2012_SIGNATURE "32a799aacf456c49"
#define ORTHOGLIDE_2012_SIGNATURE_1 0x32a799aau
#define ORTHOGLIDE_2012_SIGNATURE_2 0xcf456c49u

/* Of the calls: raised when one takes other arguments. Which version of modeler wrote the folder
 * stands in orthoglide_2012_generator.h. */
#define ORTHOGLIDE_2012_INTERFACE 2
#define ORTHOGLIDE_2012_LICENSE "MIT"

#define ORTHOGLIDE_2012_JOINTS 3
#define ORTHOGLIDE_2012_STANDARD_PARAMETERS 196
#define ORTHOGLIDE_2012_BASE_PARAMETERS 53
#define ORTHOGLIDE_2012_FREE_VARIABLES 12
#ifndef ORTHOGLIDE_2012_MAX_CLOSURE_EVALUATIONS
#define ORTHOGLIDE_2012_MAX_CLOSURE_EVALUATIONS 5000 /* in one call; -D sets another, in all files alike */
#endif

/* chi: standard parameters, columns of orthoglide_2012_regressor
 *
 *    0  M6       kg
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
 *   14  XX12     kg m2
 *   15  XY12     kg m2
 *   16  XZ12     kg m2
 *   17  YY12     kg m2
 *   18  YZ12     kg m2
 *   19  ZZ12     kg m2
 *   20  MX12     kg m
 *   21  MY12     kg m
 *   22  MZ12     kg m
 *   23  M12      kg
 *   24  Ia12     kg
 *   25  Fv12     N s/m
 *   26  Fs12     N
 *   27  XX13     kg m2
 *   28  XY13     kg m2
 *   29  XZ13     kg m2
 *   30  YY13     kg m2
 *   31  YZ13     kg m2
 *   32  ZZ13     kg m2
 *   33  MX13     kg m
 *   34  MY13     kg m
 *   35  MZ13     kg m
 *   36  M13      kg
 *   37  Ia13     kg
 *   38  Fv13     N s/m
 *   39  Fs13     N
 *   40  XX21     kg m2
 *   41  XY21     kg m2
 *   42  XZ21     kg m2
 *   43  YY21     kg m2
 *   44  YZ21     kg m2
 *   45  ZZ21     kg m2
 *   46  MX21     kg m
 *   47  MY21     kg m
 *   48  MZ21     kg m
 *   49  M21      kg
 *   50  Ia21     kg m2
 *   51  Fv21     N m s/rad
 *   52  Fs21     N m
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
 *   63  Ia31     kg m2
 *   64  Fv31     N m s/rad
 *   65  Fs31     N m
 *   66  XX41     kg m2
 *   67  XY41     kg m2
 *   68  XZ41     kg m2
 *   69  YY41     kg m2
 *   70  YZ41     kg m2
 *   71  ZZ41     kg m2
 *   72  MX41     kg m
 *   73  MY41     kg m
 *   74  MZ41     kg m
 *   75  M41      kg
 *   76  Ia41     kg m2
 *   77  Fv41     N m s/rad
 *   78  Fs41     N m
 *   79  XX51     kg m2
 *   80  XY51     kg m2
 *   81  XZ51     kg m2
 *   82  YY51     kg m2
 *   83  YZ51     kg m2
 *   84  ZZ51     kg m2
 *   85  MX51     kg m
 *   86  MY51     kg m
 *   87  MZ51     kg m
 *   88  M51      kg
 *   89  Ia51     kg m2
 *   90  Fv51     N m s/rad
 *   91  Fs51     N m
 *   92  XX22     kg m2
 *   93  XY22     kg m2
 *   94  XZ22     kg m2
 *   95  YY22     kg m2
 *   96  YZ22     kg m2
 *   97  ZZ22     kg m2
 *   98  MX22     kg m
 *   99  MY22     kg m
 *  100  MZ22     kg m
 *  101  M22      kg
 *  102  Ia22     kg m2
 *  103  Fv22     N m s/rad
 *  104  Fs22     N m
 *  105  XX32     kg m2
 *  106  XY32     kg m2
 *  107  XZ32     kg m2
 *  108  YY32     kg m2
 *  109  YZ32     kg m2
 *  110  ZZ32     kg m2
 *  111  MX32     kg m
 *  112  MY32     kg m
 *  113  MZ32     kg m
 *  114  M32      kg
 *  115  Ia32     kg m2
 *  116  Fv32     N m s/rad
 *  117  Fs32     N m
 *  118  XX42     kg m2
 *  119  XY42     kg m2
 *  120  XZ42     kg m2
 *  121  YY42     kg m2
 *  122  YZ42     kg m2
 *  123  ZZ42     kg m2
 *  124  MX42     kg m
 *  125  MY42     kg m
 *  126  MZ42     kg m
 *  127  M42      kg
 *  128  Ia42     kg m2
 *  129  Fv42     N m s/rad
 *  130  Fs42     N m
 *  131  XX52     kg m2
 *  132  XY52     kg m2
 *  133  XZ52     kg m2
 *  134  YY52     kg m2
 *  135  YZ52     kg m2
 *  136  ZZ52     kg m2
 *  137  MX52     kg m
 *  138  MY52     kg m
 *  139  MZ52     kg m
 *  140  M52      kg
 *  141  Ia52     kg m2
 *  142  Fv52     N m s/rad
 *  143  Fs52     N m
 *  144  XX23     kg m2
 *  145  XY23     kg m2
 *  146  XZ23     kg m2
 *  147  YY23     kg m2
 *  148  YZ23     kg m2
 *  149  ZZ23     kg m2
 *  150  MX23     kg m
 *  151  MY23     kg m
 *  152  MZ23     kg m
 *  153  M23      kg
 *  154  Ia23     kg m2
 *  155  Fv23     N m s/rad
 *  156  Fs23     N m
 *  157  XX33     kg m2
 *  158  XY33     kg m2
 *  159  XZ33     kg m2
 *  160  YY33     kg m2
 *  161  YZ33     kg m2
 *  162  ZZ33     kg m2
 *  163  MX33     kg m
 *  164  MY33     kg m
 *  165  MZ33     kg m
 *  166  M33      kg
 *  167  Ia33     kg m2
 *  168  Fv33     N m s/rad
 *  169  Fs33     N m
 *  170  XX43     kg m2
 *  171  XY43     kg m2
 *  172  XZ43     kg m2
 *  173  YY43     kg m2
 *  174  YZ43     kg m2
 *  175  ZZ43     kg m2
 *  176  MX43     kg m
 *  177  MY43     kg m
 *  178  MZ43     kg m
 *  179  M43      kg
 *  180  Ia43     kg m2
 *  181  Fv43     N m s/rad
 *  182  Fs43     N m
 *  183  XX53     kg m2
 *  184  XY53     kg m2
 *  185  XZ53     kg m2
 *  186  YY53     kg m2
 *  187  YZ53     kg m2
 *  188  ZZ53     kg m2
 *  189  MX53     kg m
 *  190  MY53     kg m
 *  191  MZ53     kg m
 *  192  M53      kg
 *  193  Ia53     kg m2
 *  194  Fv53     N m s/rad
 *  195  Fs53     N m
 */
enum {
    ORTHOGLIDE_2012_CHI_M6, ORTHOGLIDE_2012_CHI_XX11, ORTHOGLIDE_2012_CHI_XY11,
    ORTHOGLIDE_2012_CHI_XZ11, ORTHOGLIDE_2012_CHI_YY11, ORTHOGLIDE_2012_CHI_YZ11,
    ORTHOGLIDE_2012_CHI_ZZ11, ORTHOGLIDE_2012_CHI_MX11, ORTHOGLIDE_2012_CHI_MY11,
    ORTHOGLIDE_2012_CHI_MZ11, ORTHOGLIDE_2012_CHI_M11, ORTHOGLIDE_2012_CHI_Ia11,
    ORTHOGLIDE_2012_CHI_Fv11, ORTHOGLIDE_2012_CHI_Fs11, ORTHOGLIDE_2012_CHI_XX12,
    ORTHOGLIDE_2012_CHI_XY12, ORTHOGLIDE_2012_CHI_XZ12, ORTHOGLIDE_2012_CHI_YY12,
    ORTHOGLIDE_2012_CHI_YZ12, ORTHOGLIDE_2012_CHI_ZZ12, ORTHOGLIDE_2012_CHI_MX12,
    ORTHOGLIDE_2012_CHI_MY12, ORTHOGLIDE_2012_CHI_MZ12, ORTHOGLIDE_2012_CHI_M12,
    ORTHOGLIDE_2012_CHI_Ia12, ORTHOGLIDE_2012_CHI_Fv12, ORTHOGLIDE_2012_CHI_Fs12,
    ORTHOGLIDE_2012_CHI_XX13, ORTHOGLIDE_2012_CHI_XY13, ORTHOGLIDE_2012_CHI_XZ13,
    ORTHOGLIDE_2012_CHI_YY13, ORTHOGLIDE_2012_CHI_YZ13, ORTHOGLIDE_2012_CHI_ZZ13,
    ORTHOGLIDE_2012_CHI_MX13, ORTHOGLIDE_2012_CHI_MY13, ORTHOGLIDE_2012_CHI_MZ13,
    ORTHOGLIDE_2012_CHI_M13, ORTHOGLIDE_2012_CHI_Ia13, ORTHOGLIDE_2012_CHI_Fv13,
    ORTHOGLIDE_2012_CHI_Fs13, ORTHOGLIDE_2012_CHI_XX21, ORTHOGLIDE_2012_CHI_XY21,
    ORTHOGLIDE_2012_CHI_XZ21, ORTHOGLIDE_2012_CHI_YY21, ORTHOGLIDE_2012_CHI_YZ21,
    ORTHOGLIDE_2012_CHI_ZZ21, ORTHOGLIDE_2012_CHI_MX21, ORTHOGLIDE_2012_CHI_MY21,
    ORTHOGLIDE_2012_CHI_MZ21, ORTHOGLIDE_2012_CHI_M21, ORTHOGLIDE_2012_CHI_Ia21,
    ORTHOGLIDE_2012_CHI_Fv21, ORTHOGLIDE_2012_CHI_Fs21, ORTHOGLIDE_2012_CHI_XX31,
    ORTHOGLIDE_2012_CHI_XY31, ORTHOGLIDE_2012_CHI_XZ31, ORTHOGLIDE_2012_CHI_YY31,
    ORTHOGLIDE_2012_CHI_YZ31, ORTHOGLIDE_2012_CHI_ZZ31, ORTHOGLIDE_2012_CHI_MX31,
    ORTHOGLIDE_2012_CHI_MY31, ORTHOGLIDE_2012_CHI_MZ31, ORTHOGLIDE_2012_CHI_M31,
    ORTHOGLIDE_2012_CHI_Ia31, ORTHOGLIDE_2012_CHI_Fv31, ORTHOGLIDE_2012_CHI_Fs31,
    ORTHOGLIDE_2012_CHI_XX41, ORTHOGLIDE_2012_CHI_XY41, ORTHOGLIDE_2012_CHI_XZ41,
    ORTHOGLIDE_2012_CHI_YY41, ORTHOGLIDE_2012_CHI_YZ41, ORTHOGLIDE_2012_CHI_ZZ41,
    ORTHOGLIDE_2012_CHI_MX41, ORTHOGLIDE_2012_CHI_MY41, ORTHOGLIDE_2012_CHI_MZ41,
    ORTHOGLIDE_2012_CHI_M41, ORTHOGLIDE_2012_CHI_Ia41, ORTHOGLIDE_2012_CHI_Fv41,
    ORTHOGLIDE_2012_CHI_Fs41, ORTHOGLIDE_2012_CHI_XX51, ORTHOGLIDE_2012_CHI_XY51,
    ORTHOGLIDE_2012_CHI_XZ51, ORTHOGLIDE_2012_CHI_YY51, ORTHOGLIDE_2012_CHI_YZ51,
    ORTHOGLIDE_2012_CHI_ZZ51, ORTHOGLIDE_2012_CHI_MX51, ORTHOGLIDE_2012_CHI_MY51,
    ORTHOGLIDE_2012_CHI_MZ51, ORTHOGLIDE_2012_CHI_M51, ORTHOGLIDE_2012_CHI_Ia51,
    ORTHOGLIDE_2012_CHI_Fv51, ORTHOGLIDE_2012_CHI_Fs51, ORTHOGLIDE_2012_CHI_XX22,
    ORTHOGLIDE_2012_CHI_XY22, ORTHOGLIDE_2012_CHI_XZ22, ORTHOGLIDE_2012_CHI_YY22,
    ORTHOGLIDE_2012_CHI_YZ22, ORTHOGLIDE_2012_CHI_ZZ22, ORTHOGLIDE_2012_CHI_MX22,
    ORTHOGLIDE_2012_CHI_MY22, ORTHOGLIDE_2012_CHI_MZ22, ORTHOGLIDE_2012_CHI_M22,
    ORTHOGLIDE_2012_CHI_Ia22, ORTHOGLIDE_2012_CHI_Fv22, ORTHOGLIDE_2012_CHI_Fs22,
    ORTHOGLIDE_2012_CHI_XX32, ORTHOGLIDE_2012_CHI_XY32, ORTHOGLIDE_2012_CHI_XZ32,
    ORTHOGLIDE_2012_CHI_YY32, ORTHOGLIDE_2012_CHI_YZ32, ORTHOGLIDE_2012_CHI_ZZ32,
    ORTHOGLIDE_2012_CHI_MX32, ORTHOGLIDE_2012_CHI_MY32, ORTHOGLIDE_2012_CHI_MZ32,
    ORTHOGLIDE_2012_CHI_M32, ORTHOGLIDE_2012_CHI_Ia32, ORTHOGLIDE_2012_CHI_Fv32,
    ORTHOGLIDE_2012_CHI_Fs32, ORTHOGLIDE_2012_CHI_XX42, ORTHOGLIDE_2012_CHI_XY42,
    ORTHOGLIDE_2012_CHI_XZ42, ORTHOGLIDE_2012_CHI_YY42, ORTHOGLIDE_2012_CHI_YZ42,
    ORTHOGLIDE_2012_CHI_ZZ42, ORTHOGLIDE_2012_CHI_MX42, ORTHOGLIDE_2012_CHI_MY42,
    ORTHOGLIDE_2012_CHI_MZ42, ORTHOGLIDE_2012_CHI_M42, ORTHOGLIDE_2012_CHI_Ia42,
    ORTHOGLIDE_2012_CHI_Fv42, ORTHOGLIDE_2012_CHI_Fs42, ORTHOGLIDE_2012_CHI_XX52,
    ORTHOGLIDE_2012_CHI_XY52, ORTHOGLIDE_2012_CHI_XZ52, ORTHOGLIDE_2012_CHI_YY52,
    ORTHOGLIDE_2012_CHI_YZ52, ORTHOGLIDE_2012_CHI_ZZ52, ORTHOGLIDE_2012_CHI_MX52,
    ORTHOGLIDE_2012_CHI_MY52, ORTHOGLIDE_2012_CHI_MZ52, ORTHOGLIDE_2012_CHI_M52,
    ORTHOGLIDE_2012_CHI_Ia52, ORTHOGLIDE_2012_CHI_Fv52, ORTHOGLIDE_2012_CHI_Fs52,
    ORTHOGLIDE_2012_CHI_XX23, ORTHOGLIDE_2012_CHI_XY23, ORTHOGLIDE_2012_CHI_XZ23,
    ORTHOGLIDE_2012_CHI_YY23, ORTHOGLIDE_2012_CHI_YZ23, ORTHOGLIDE_2012_CHI_ZZ23,
    ORTHOGLIDE_2012_CHI_MX23, ORTHOGLIDE_2012_CHI_MY23, ORTHOGLIDE_2012_CHI_MZ23,
    ORTHOGLIDE_2012_CHI_M23, ORTHOGLIDE_2012_CHI_Ia23, ORTHOGLIDE_2012_CHI_Fv23,
    ORTHOGLIDE_2012_CHI_Fs23, ORTHOGLIDE_2012_CHI_XX33, ORTHOGLIDE_2012_CHI_XY33,
    ORTHOGLIDE_2012_CHI_XZ33, ORTHOGLIDE_2012_CHI_YY33, ORTHOGLIDE_2012_CHI_YZ33,
    ORTHOGLIDE_2012_CHI_ZZ33, ORTHOGLIDE_2012_CHI_MX33, ORTHOGLIDE_2012_CHI_MY33,
    ORTHOGLIDE_2012_CHI_MZ33, ORTHOGLIDE_2012_CHI_M33, ORTHOGLIDE_2012_CHI_Ia33,
    ORTHOGLIDE_2012_CHI_Fv33, ORTHOGLIDE_2012_CHI_Fs33, ORTHOGLIDE_2012_CHI_XX43,
    ORTHOGLIDE_2012_CHI_XY43, ORTHOGLIDE_2012_CHI_XZ43, ORTHOGLIDE_2012_CHI_YY43,
    ORTHOGLIDE_2012_CHI_YZ43, ORTHOGLIDE_2012_CHI_ZZ43, ORTHOGLIDE_2012_CHI_MX43,
    ORTHOGLIDE_2012_CHI_MY43, ORTHOGLIDE_2012_CHI_MZ43, ORTHOGLIDE_2012_CHI_M43,
    ORTHOGLIDE_2012_CHI_Ia43, ORTHOGLIDE_2012_CHI_Fv43, ORTHOGLIDE_2012_CHI_Fs43,
    ORTHOGLIDE_2012_CHI_XX53, ORTHOGLIDE_2012_CHI_XY53, ORTHOGLIDE_2012_CHI_XZ53,
    ORTHOGLIDE_2012_CHI_YY53, ORTHOGLIDE_2012_CHI_YZ53, ORTHOGLIDE_2012_CHI_ZZ53,
    ORTHOGLIDE_2012_CHI_MX53, ORTHOGLIDE_2012_CHI_MY53, ORTHOGLIDE_2012_CHI_MZ53,
    ORTHOGLIDE_2012_CHI_M53, ORTHOGLIDE_2012_CHI_Ia53, ORTHOGLIDE_2012_CHI_Fv53,
    ORTHOGLIDE_2012_CHI_Fs53
};

/* beta: base parameters, columns of orthoglide_2012_base_regressor
 *
 *    0  M11R = M11 + M6 + Ia11 + M21 + M31 + M41 + M51 + MX32/d4 + M42 + M52 + MX33/d4 + M43 + M53
 *         [kg]
 *    1  Fv11  [N s/m]
 *    2  Fs11  [N]
 *    3  M12R = M12 + Ia12 + M22 - MX32/d4 + M32  [kg]
 *    4  Fv12  [N s/m]
 *    5  Fs12  [N]
 *    6  M13R = M13 + M23 - MX33/d4 + M33  [kg]
 *    7  Ia13  [kg]
 *    8  Fv13  [N s/m]
 *    9  Fs13  [N]
 *   10  ZZ21R = ZZ21 + d4**2*M6 + Ia21 + YY31 + YY41 + d4**2*M41 + d4**2*M51 + Ia51 + d4*MX32 +
 *         d4**2*M42 + d4**2*M52 + d4*MX33 + d4**2*M43 + d4**2*M53  [kg m2]
 *   11  MX21  [kg m]
 *   12  MY21R = MY21 + MZ31 + MZ41  [kg m]
 *   13  Fv21R = Fv21 + Fv51  [N m s/rad]
 *   14  Fs21R = Fs21 + Fs51  [N m]
 *   15  XX31R = XX31 - d4**2*M6 - YY31 - d4**2*M41 - d4**2*M51 - d4*MX32 - d4**2*M42 - d4**2*M52 -
 *         d4*MX33 - d4**2*M43 - d4**2*M53  [kg m2]
 *   16  XY31  [kg m2]
 *   17  XZ31R = XZ31 - d4*MZ41  [kg m2]
 *   18  YZ31  [kg m2]
 *   19  ZZ31R = ZZ31 + d4**2*M6 + Ia31 + d4**2*M41 + Ia41 + d4**2*M51 + d4*MX32 + d4**2*M42 +
 *         d4**2*M52 + d4*MX33 + d4**2*M43 + d4**2*M53  [kg m2]
 *   20  MX31R = MX31 + d4*M6 + d4*M41 + d4*M51 + MX32 + d4*M42 + d4*M52 + MX33 + d4*M43 + d4*M53
 *         [kg m]
 *   21  MY31  [kg m]
 *   22  Fv31R = Fv31 + Fv41  [N m s/rad]
 *   23  Fs31R = Fs31 + Fs41  [N m]
 *   24  MX41  [kg m]
 *   25  ZZ22R = ZZ22 + Ia22 + YY32 - d4*MX32 + YY42 + Ia52  [kg m2]
 *   26  MX22  [kg m]
 *   27  MY22R = MY22 + MZ32 + MZ42  [kg m]
 *   28  Fv22R = Fv22 + Fv52  [N m s/rad]
 *   29  Fs22R = Fs22 + Fs52  [N m]
 *   30  XX32R = XX32 - YY32 + d4*MX32  [kg m2]
 *   31  XY32  [kg m2]
 *   32  XZ32R = XZ32 - d4*MZ42  [kg m2]
 *   33  YZ32  [kg m2]
 *   34  ZZ32R = ZZ32 - d4*MX32 + Ia32 + Ia42  [kg m2]
 *   35  MY32  [kg m]
 *   36  Fv32R = Fv32 + Fv42  [N m s/rad]
 *   37  Fs32R = Fs32 + Fs42  [N m]
 *   38  MX42  [kg m]
 *   39  ZZ23R = ZZ23 + Ia23 + YY33 - d4*MX33 + YY43 + Ia53  [kg m2]
 *   40  MX23  [kg m]
 *   41  MY23R = MY23 + MZ33 + MZ43  [kg m]
 *   42  Fv23R = Fv23 + Fv53  [N m s/rad]
 *   43  Fs23R = Fs23 + Fs53  [N m]
 *   44  XX33R = XX33 - YY33 + d4*MX33  [kg m2]
 *   45  XY33  [kg m2]
 *   46  XZ33R = XZ33 - d4*MZ43  [kg m2]
 *   47  YZ33  [kg m2]
 *   48  ZZ33R = ZZ33 - d4*MX33 + Ia33 + Ia43  [kg m2]
 *   49  MY33  [kg m]
 *   50  Fv33R = Fv33 + Fv43  [N m s/rad]
 *   51  Fs33R = Fs33 + Fs43  [N m]
 *   52  MX43  [kg m]
 */
enum {
    ORTHOGLIDE_2012_BETA_M11R, ORTHOGLIDE_2012_BETA_Fv11, ORTHOGLIDE_2012_BETA_Fs11,
    ORTHOGLIDE_2012_BETA_M12R, ORTHOGLIDE_2012_BETA_Fv12, ORTHOGLIDE_2012_BETA_Fs12,
    ORTHOGLIDE_2012_BETA_M13R, ORTHOGLIDE_2012_BETA_Ia13, ORTHOGLIDE_2012_BETA_Fv13,
    ORTHOGLIDE_2012_BETA_Fs13, ORTHOGLIDE_2012_BETA_ZZ21R, ORTHOGLIDE_2012_BETA_MX21,
    ORTHOGLIDE_2012_BETA_MY21R, ORTHOGLIDE_2012_BETA_Fv21R, ORTHOGLIDE_2012_BETA_Fs21R,
    ORTHOGLIDE_2012_BETA_XX31R, ORTHOGLIDE_2012_BETA_XY31, ORTHOGLIDE_2012_BETA_XZ31R,
    ORTHOGLIDE_2012_BETA_YZ31, ORTHOGLIDE_2012_BETA_ZZ31R, ORTHOGLIDE_2012_BETA_MX31R,
    ORTHOGLIDE_2012_BETA_MY31, ORTHOGLIDE_2012_BETA_Fv31R, ORTHOGLIDE_2012_BETA_Fs31R,
    ORTHOGLIDE_2012_BETA_MX41, ORTHOGLIDE_2012_BETA_ZZ22R, ORTHOGLIDE_2012_BETA_MX22,
    ORTHOGLIDE_2012_BETA_MY22R, ORTHOGLIDE_2012_BETA_Fv22R, ORTHOGLIDE_2012_BETA_Fs22R,
    ORTHOGLIDE_2012_BETA_XX32R, ORTHOGLIDE_2012_BETA_XY32, ORTHOGLIDE_2012_BETA_XZ32R,
    ORTHOGLIDE_2012_BETA_YZ32, ORTHOGLIDE_2012_BETA_ZZ32R, ORTHOGLIDE_2012_BETA_MY32,
    ORTHOGLIDE_2012_BETA_Fv32R, ORTHOGLIDE_2012_BETA_Fs32R, ORTHOGLIDE_2012_BETA_MX42,
    ORTHOGLIDE_2012_BETA_ZZ23R, ORTHOGLIDE_2012_BETA_MX23, ORTHOGLIDE_2012_BETA_MY23R,
    ORTHOGLIDE_2012_BETA_Fv23R, ORTHOGLIDE_2012_BETA_Fs23R, ORTHOGLIDE_2012_BETA_XX33R,
    ORTHOGLIDE_2012_BETA_XY33, ORTHOGLIDE_2012_BETA_XZ33R, ORTHOGLIDE_2012_BETA_YZ33,
    ORTHOGLIDE_2012_BETA_ZZ33R, ORTHOGLIDE_2012_BETA_MY33, ORTHOGLIDE_2012_BETA_Fv33R,
    ORTHOGLIDE_2012_BETA_Fs33R, ORTHOGLIDE_2012_BETA_MX43
};

/* u: free variables of the opened tree: 6x, 6y, 6, 11, 12, 13, 21, 31, 22, 32, 23, 33
 *
 * Functions that close the loops return a status: 0 done; 1 the loops cannot be closed on the
 * straight way from the home posture to these values; 2 singular posture; 3 an input is not finite,
 * or an output would not be; 4 these values are so far that ORTHOGLIDE_2012_MAX_CLOSURE_EVALUATIONS
 * evaluations of the closure equations do not do: no call makes more. Outputs are NaN unless it is 0. The assembly
 * mode is that of the home posture.
 */

/* Tells whether this code belongs to a manifest. */
const char *orthoglide_2012_signature(void);

/* Regressor of the standard parameters.
 *
 * tau = phi chi
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * qdd    3        joint accelerations [m/s2]
 * phi    3 x 196  torque per unit of each standard parameter, row-major [SI]
 */
int orthoglide_2012_regressor(const double q[ORTHOGLIDE_2012_JOINTS],
                              const double qd[ORTHOGLIDE_2012_JOINTS],
                              const double qdd[ORTHOGLIDE_2012_JOINTS], double phi[3 * 196]);

/* Regressor of the base parameters.
 *
 * tau = phi beta
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * qdd    3        joint accelerations [m/s2]
 * phi    3 x 53   torque per unit of each base parameter, row-major [SI]
 */
int orthoglide_2012_base_regressor(const double q[ORTHOGLIDE_2012_JOINTS],
                                   const double qd[ORTHOGLIDE_2012_JOINTS],
                                   const double qdd[ORTHOGLIDE_2012_JOINTS], double phi[3 * 53]);

/* Torques that move the closed robot so.
 *
 * tau = M qdd + c + g + f
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * qdd    3        joint accelerations [m/s2]
 * beta   53       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2012_inverse_dynamics(const double q[ORTHOGLIDE_2012_JOINTS],
                                     const double qd[ORTHOGLIDE_2012_JOINTS],
                                     const double qdd[ORTHOGLIDE_2012_JOINTS],
                                     const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                                     double tau[ORTHOGLIDE_2012_JOINTS]);

/* Torques that hold the robot still, without friction.
 *
 * g(q) = tau(q, 0, 0) without effects
 *
 * q      3        joint positions [m]
 * beta   53       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2012_gravity(const double q[ORTHOGLIDE_2012_JOINTS],
                            const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                            double tau[ORTHOGLIDE_2012_JOINTS]);

/* Coriolis and centripetal torques.
 *
 * c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * beta   53       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2012_coriolis(const double q[ORTHOGLIDE_2012_JOINTS],
                             const double qd[ORTHOGLIDE_2012_JOINTS],
                             const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                             double tau[ORTHOGLIDE_2012_JOINTS]);

/* Torques of all effects but rotor inertias: friction, offsets.
 *
 * f(q, qd)
 *
 * q      3        joint positions [m]
 * qd     3        joint velocities [m/s]
 * beta   53       base parameters [SI]
 * tau    3        joint torques or forces [N]
 */
int orthoglide_2012_friction(const double q[ORTHOGLIDE_2012_JOINTS],
                             const double qd[ORTHOGLIDE_2012_JOINTS],
                             const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                             double tau[ORTHOGLIDE_2012_JOINTS]);

/* Inertia matrix, rotor inertias included; symmetric.
 *
 * tau = M(q) qdd + ...
 *
 * q      3        joint positions [m]
 * beta   53       base parameters [SI]
 * M      3 x 3    inertia matrix, row-major [kg m2, kg m or kg]
 */
int orthoglide_2012_inertia_matrix(const double q[ORTHOGLIDE_2012_JOINTS],
                                   const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                                   double M[3 * 3]);

/* Pose of the frame of every moving row of the table.
 *
 * x0 = R x + p with T = [R | p], for a point x of the frame
 *
 * q      3          joint positions [m]
 * T      18 x 3 x 4 poses [R | p] of rows 6x, 6y, 6, 11, 12, 13, 21, 31, 41, 51, 22, 32, 42, 52,
 *                   23, 33, 43, 53 in frame 0, row-major [1 | m]
 */
int orthoglide_2012_forward_kinematics(const double q[ORTHOGLIDE_2012_JOINTS],
                                       double T[18 * 3 * 4]);

/* Closed posture, on a straight way from home.
 *
 * f(u) = 0
 *
 * q      3        joint positions [m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2012_close(const double q[ORTHOGLIDE_2012_JOINTS], double u[12]);

/* Closed posture, on a straight way from another one, such as the last.
 *
 * f(u) = 0
 *
 * q      3        joint positions [m]
 * start  12       a closed posture to start from [rad or m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2012_close_from(const double q[ORTHOGLIDE_2012_JOINTS], const double start[12],
                               double u[12]);

/* Speeds of the free variables; rows of the platform are its Jacobian.
 *
 * ud = G qd
 *
 * q      3        joint positions [m]
 * G      12 x 3   d u / d q, row-major [SI]
 */
int orthoglide_2012_coupling(const double q[ORTHOGLIDE_2012_JOINTS], double G[12 * 3]);

/* Base parameters from standard ones: the grouping relations.
 *
 * beta = K chi
 *
 * chi    196      standard parameters [SI]
 * beta   53       base parameters [SI]
 */
void orthoglide_2012_base_parameters(const double chi[ORTHOGLIDE_2012_STANDARD_PARAMETERS],
                                     double beta[ORTHOGLIDE_2012_BASE_PARAMETERS]);

/* Regressor of the base parameters.
 *
 * f = phi beta
 *
 * x      3        positions of the platform: 6x, 6y, 6 [m]
 * xd     3        their velocities [m/s]
 * xdd    3        their accelerations [m/s2]
 * phi    3 x 53   torque per unit of each base parameter, row-major [SI]
 */
int orthoglide_2012_platform_base_regressor(const double x[3], const double xd[3],
                                            const double xdd[3], double phi[3 * 53]);

/* Torques that move the closed robot so.
 *
 * f = M xdd + c + g + f
 *
 * x      3        positions of the platform: 6x, 6y, 6 [m]
 * xd     3        their velocities [m/s]
 * xdd    3        their accelerations [m/s2]
 * beta   53       base parameters [SI]
 * f      3        forces and torques along x [N]
 */
int orthoglide_2012_platform_inverse_dynamics(const double x[3], const double xd[3],
                                              const double xdd[3],
                                              const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                                              double f[3]);

/* Closed posture, on a straight way from home.
 *
 * f(u) = 0
 *
 * x      3        positions of the platform: 6x, 6y, 6 [m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2012_platform_close(const double x[3], double u[12]);

/* Closed posture, on a straight way from another one, such as the last.
 *
 * f(u) = 0
 *
 * x      3        positions of the platform: 6x, 6y, 6 [m]
 * start  12       a closed posture to start from [rad or m]
 * u      12       free variables of the opened tree [rad or m]
 */
int orthoglide_2012_platform_close_from(const double x[3], const double start[12], double u[12]);

/* Speeds of the free variables; rows of the platform are its Jacobian.
 *
 * ud = G xd
 *
 * x      3        positions of the platform: 6x, 6y, 6 [m]
 * G      12 x 3   d u / d x, row-major [SI]
 */
int orthoglide_2012_platform_coupling(const double x[3], double G[12 * 3]);

/* A closed posture and what solved it, and a controller's state: members are the library's. */
struct orthoglide_2012_posture {
    double u[12];      /* free variables */
    double ud[12];     /* their speeds */
    double gamma[12];  /* their accelerations at qdd = 0 */
    double G[36];
    double qd[3];
    modeler_kept kept;
    int places[30];
    double numbers[458];
};

struct orthoglide_2012_state {
    struct orthoglide_2012_posture at;
    int closed; /* by the last call of orthoglide_2012_state; memory of zeros is no state yet */
    int status;
    int rated; /* `rate` holds dG/dt */
    double rate[36];
    double rows[636];
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
int orthoglide_2012_state(const double *q, const double *qd, const double *previous,
    struct orthoglide_2012_state *state);

/* The same with at most `evaluations` of the closure equations, and never more than
 * ORTHOGLIDE_2012_MAX_CLOSURE_EVALUATIONS: status 4 if these do not do. */
int orthoglide_2012_state_with_bound(const double *q, const double *qd, const double *previous,
    int evaluations, struct orthoglide_2012_state *state);
#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
int orthoglide_2012_base_regressor_at(struct orthoglide_2012_state *state,
                                      const double qdd[ORTHOGLIDE_2012_JOINTS], double phi[3 * 53]);
int orthoglide_2012_inverse_dynamics_at(struct orthoglide_2012_state *state,
                                        const double qdd[ORTHOGLIDE_2012_JOINTS],
                                        const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                                        double tau[ORTHOGLIDE_2012_JOINTS]);
int orthoglide_2012_gravity_at(struct orthoglide_2012_state *state,
                               const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                               double tau[ORTHOGLIDE_2012_JOINTS]);
int orthoglide_2012_coriolis_at(struct orthoglide_2012_state *state,
                                const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                                double tau[ORTHOGLIDE_2012_JOINTS]);
int orthoglide_2012_friction_at(struct orthoglide_2012_state *state,
                                const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                                double tau[ORTHOGLIDE_2012_JOINTS]);
int orthoglide_2012_inertia_matrix_at(struct orthoglide_2012_state *state,
                                      const double beta[ORTHOGLIDE_2012_BASE_PARAMETERS],
                                      double M[3 * 3]);
int orthoglide_2012_forward_kinematics_at(struct orthoglide_2012_state *state,
                                          double T[18 * 3 * 4]);
int orthoglide_2012_coupling_at(struct orthoglide_2012_state *state, double G[12 * 3]);

/* dG/dt, as G: udd = G qdd + dG/dt qd. `rate` may be NULL: it is kept in the state. */
int orthoglide_2012_coupling_rate_at(struct orthoglide_2012_state *state, double *rate);

#ifdef __cplusplus
}
#endif

#endif
