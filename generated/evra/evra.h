/* Evr@ simulator, 6-UPS platform on two sliders (Houda, Amouri, Beji, Mallem)
 *
 * SPDX-License-Identifier: MIT
 *
 * Dynamic model, linear in its parameters: tau = M(q) qdd + c(q, qd) + g(q) + f(qd) = phi beta.
 * C99, no dependency but <math.h>, no allocation, no global state, re-entrant.
 *
 * Joints, in the order of q, qd, qdd, tau: s1, s2, 31, 32, 33, 34, 35, 36.
 * SI units. Matrices are row-major. Outputs must not overlap inputs.
 *
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#ifndef EVRA_H
#define EVRA_H

#include <stddef.h>

#include "modeler_kept.h"
#include "modeler_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What evra_signature() of the library that belongs to this header returns. */
#define EVRA_SIGNATURE "e1952a67b957d79a"
#define EVRA_SIGNATURE_1 0xe1952a67u
#define EVRA_SIGNATURE_2 0xb957d79au

/* Of the calls: raised when one takes other arguments. Which version of modeler wrote the folder
 * stands in evra_generator.h. */
#define EVRA_INTERFACE 2
#define EVRA_LICENSE "MIT"

#define EVRA_JOINTS 8
#define EVRA_STANDARD_PARAMETERS 210
#define EVRA_BASE_PARAMETERS 90
#define EVRA_FREE_VARIABLES 26
#ifndef EVRA_MAX_CLOSURE_EVALUATIONS
#define EVRA_MAX_CLOSURE_EVALUATIONS 5000 /* in one call; -D sets another, in all files alike */
#endif

/* chi: standard parameters, columns of evra_regressor
 *
 *    0  XXP      kg m2
 *    1  XYP      kg m2
 *    2  XZP      kg m2
 *    3  YYP      kg m2
 *    4  YZP      kg m2
 *    5  ZZP      kg m2
 *    6  MXP      kg m
 *    7  MYP      kg m
 *    8  MZP      kg m
 *    9  MP       kg
 *   10  XXs1     kg m2
 *   11  XYs1     kg m2
 *   12  XZs1     kg m2
 *   13  YYs1     kg m2
 *   14  YZs1     kg m2
 *   15  ZZs1     kg m2
 *   16  MXs1     kg m
 *   17  MYs1     kg m
 *   18  MZs1     kg m
 *   19  Ms1      kg
 *   20  XXs2     kg m2
 *   21  XYs2     kg m2
 *   22  XZs2     kg m2
 *   23  YYs2     kg m2
 *   24  YZs2     kg m2
 *   25  ZZs2     kg m2
 *   26  MXs2     kg m
 *   27  MYs2     kg m
 *   28  MZs2     kg m
 *   29  Ms2      kg
 *   30  XX11     kg m2
 *   31  XY11     kg m2
 *   32  XZ11     kg m2
 *   33  YY11     kg m2
 *   34  YZ11     kg m2
 *   35  ZZ11     kg m2
 *   36  MX11     kg m
 *   37  MY11     kg m
 *   38  MZ11     kg m
 *   39  M11      kg
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
 *   50  XX31     kg m2
 *   51  XY31     kg m2
 *   52  XZ31     kg m2
 *   53  YY31     kg m2
 *   54  YZ31     kg m2
 *   55  ZZ31     kg m2
 *   56  MX31     kg m
 *   57  MY31     kg m
 *   58  MZ31     kg m
 *   59  M31      kg
 *   60  XX12     kg m2
 *   61  XY12     kg m2
 *   62  XZ12     kg m2
 *   63  YY12     kg m2
 *   64  YZ12     kg m2
 *   65  ZZ12     kg m2
 *   66  MX12     kg m
 *   67  MY12     kg m
 *   68  MZ12     kg m
 *   69  M12      kg
 *   70  XX22     kg m2
 *   71  XY22     kg m2
 *   72  XZ22     kg m2
 *   73  YY22     kg m2
 *   74  YZ22     kg m2
 *   75  ZZ22     kg m2
 *   76  MX22     kg m
 *   77  MY22     kg m
 *   78  MZ22     kg m
 *   79  M22      kg
 *   80  XX32     kg m2
 *   81  XY32     kg m2
 *   82  XZ32     kg m2
 *   83  YY32     kg m2
 *   84  YZ32     kg m2
 *   85  ZZ32     kg m2
 *   86  MX32     kg m
 *   87  MY32     kg m
 *   88  MZ32     kg m
 *   89  M32      kg
 *   90  XX13     kg m2
 *   91  XY13     kg m2
 *   92  XZ13     kg m2
 *   93  YY13     kg m2
 *   94  YZ13     kg m2
 *   95  ZZ13     kg m2
 *   96  MX13     kg m
 *   97  MY13     kg m
 *   98  MZ13     kg m
 *   99  M13      kg
 *  100  XX23     kg m2
 *  101  XY23     kg m2
 *  102  XZ23     kg m2
 *  103  YY23     kg m2
 *  104  YZ23     kg m2
 *  105  ZZ23     kg m2
 *  106  MX23     kg m
 *  107  MY23     kg m
 *  108  MZ23     kg m
 *  109  M23      kg
 *  110  XX33     kg m2
 *  111  XY33     kg m2
 *  112  XZ33     kg m2
 *  113  YY33     kg m2
 *  114  YZ33     kg m2
 *  115  ZZ33     kg m2
 *  116  MX33     kg m
 *  117  MY33     kg m
 *  118  MZ33     kg m
 *  119  M33      kg
 *  120  XX14     kg m2
 *  121  XY14     kg m2
 *  122  XZ14     kg m2
 *  123  YY14     kg m2
 *  124  YZ14     kg m2
 *  125  ZZ14     kg m2
 *  126  MX14     kg m
 *  127  MY14     kg m
 *  128  MZ14     kg m
 *  129  M14      kg
 *  130  XX24     kg m2
 *  131  XY24     kg m2
 *  132  XZ24     kg m2
 *  133  YY24     kg m2
 *  134  YZ24     kg m2
 *  135  ZZ24     kg m2
 *  136  MX24     kg m
 *  137  MY24     kg m
 *  138  MZ24     kg m
 *  139  M24      kg
 *  140  XX34     kg m2
 *  141  XY34     kg m2
 *  142  XZ34     kg m2
 *  143  YY34     kg m2
 *  144  YZ34     kg m2
 *  145  ZZ34     kg m2
 *  146  MX34     kg m
 *  147  MY34     kg m
 *  148  MZ34     kg m
 *  149  M34      kg
 *  150  XX15     kg m2
 *  151  XY15     kg m2
 *  152  XZ15     kg m2
 *  153  YY15     kg m2
 *  154  YZ15     kg m2
 *  155  ZZ15     kg m2
 *  156  MX15     kg m
 *  157  MY15     kg m
 *  158  MZ15     kg m
 *  159  M15      kg
 *  160  XX25     kg m2
 *  161  XY25     kg m2
 *  162  XZ25     kg m2
 *  163  YY25     kg m2
 *  164  YZ25     kg m2
 *  165  ZZ25     kg m2
 *  166  MX25     kg m
 *  167  MY25     kg m
 *  168  MZ25     kg m
 *  169  M25      kg
 *  170  XX35     kg m2
 *  171  XY35     kg m2
 *  172  XZ35     kg m2
 *  173  YY35     kg m2
 *  174  YZ35     kg m2
 *  175  ZZ35     kg m2
 *  176  MX35     kg m
 *  177  MY35     kg m
 *  178  MZ35     kg m
 *  179  M35      kg
 *  180  XX16     kg m2
 *  181  XY16     kg m2
 *  182  XZ16     kg m2
 *  183  YY16     kg m2
 *  184  YZ16     kg m2
 *  185  ZZ16     kg m2
 *  186  MX16     kg m
 *  187  MY16     kg m
 *  188  MZ16     kg m
 *  189  M16      kg
 *  190  XX26     kg m2
 *  191  XY26     kg m2
 *  192  XZ26     kg m2
 *  193  YY26     kg m2
 *  194  YZ26     kg m2
 *  195  ZZ26     kg m2
 *  196  MX26     kg m
 *  197  MY26     kg m
 *  198  MZ26     kg m
 *  199  M26      kg
 *  200  XX36     kg m2
 *  201  XY36     kg m2
 *  202  XZ36     kg m2
 *  203  YY36     kg m2
 *  204  YZ36     kg m2
 *  205  ZZ36     kg m2
 *  206  MX36     kg m
 *  207  MY36     kg m
 *  208  MZ36     kg m
 *  209  M36      kg
 */
enum {
    EVRA_CHI_XXP, EVRA_CHI_XYP, EVRA_CHI_XZP, EVRA_CHI_YYP, EVRA_CHI_YZP, EVRA_CHI_ZZP,
    EVRA_CHI_MXP, EVRA_CHI_MYP, EVRA_CHI_MZP, EVRA_CHI_MP, EVRA_CHI_XXs1, EVRA_CHI_XYs1,
    EVRA_CHI_XZs1, EVRA_CHI_YYs1, EVRA_CHI_YZs1, EVRA_CHI_ZZs1, EVRA_CHI_MXs1, EVRA_CHI_MYs1,
    EVRA_CHI_MZs1, EVRA_CHI_Ms1, EVRA_CHI_XXs2, EVRA_CHI_XYs2, EVRA_CHI_XZs2, EVRA_CHI_YYs2,
    EVRA_CHI_YZs2, EVRA_CHI_ZZs2, EVRA_CHI_MXs2, EVRA_CHI_MYs2, EVRA_CHI_MZs2, EVRA_CHI_Ms2,
    EVRA_CHI_XX11, EVRA_CHI_XY11, EVRA_CHI_XZ11, EVRA_CHI_YY11, EVRA_CHI_YZ11, EVRA_CHI_ZZ11,
    EVRA_CHI_MX11, EVRA_CHI_MY11, EVRA_CHI_MZ11, EVRA_CHI_M11, EVRA_CHI_XX21, EVRA_CHI_XY21,
    EVRA_CHI_XZ21, EVRA_CHI_YY21, EVRA_CHI_YZ21, EVRA_CHI_ZZ21, EVRA_CHI_MX21, EVRA_CHI_MY21,
    EVRA_CHI_MZ21, EVRA_CHI_M21, EVRA_CHI_XX31, EVRA_CHI_XY31, EVRA_CHI_XZ31, EVRA_CHI_YY31,
    EVRA_CHI_YZ31, EVRA_CHI_ZZ31, EVRA_CHI_MX31, EVRA_CHI_MY31, EVRA_CHI_MZ31, EVRA_CHI_M31,
    EVRA_CHI_XX12, EVRA_CHI_XY12, EVRA_CHI_XZ12, EVRA_CHI_YY12, EVRA_CHI_YZ12, EVRA_CHI_ZZ12,
    EVRA_CHI_MX12, EVRA_CHI_MY12, EVRA_CHI_MZ12, EVRA_CHI_M12, EVRA_CHI_XX22, EVRA_CHI_XY22,
    EVRA_CHI_XZ22, EVRA_CHI_YY22, EVRA_CHI_YZ22, EVRA_CHI_ZZ22, EVRA_CHI_MX22, EVRA_CHI_MY22,
    EVRA_CHI_MZ22, EVRA_CHI_M22, EVRA_CHI_XX32, EVRA_CHI_XY32, EVRA_CHI_XZ32, EVRA_CHI_YY32,
    EVRA_CHI_YZ32, EVRA_CHI_ZZ32, EVRA_CHI_MX32, EVRA_CHI_MY32, EVRA_CHI_MZ32, EVRA_CHI_M32,
    EVRA_CHI_XX13, EVRA_CHI_XY13, EVRA_CHI_XZ13, EVRA_CHI_YY13, EVRA_CHI_YZ13, EVRA_CHI_ZZ13,
    EVRA_CHI_MX13, EVRA_CHI_MY13, EVRA_CHI_MZ13, EVRA_CHI_M13, EVRA_CHI_XX23, EVRA_CHI_XY23,
    EVRA_CHI_XZ23, EVRA_CHI_YY23, EVRA_CHI_YZ23, EVRA_CHI_ZZ23, EVRA_CHI_MX23, EVRA_CHI_MY23,
    EVRA_CHI_MZ23, EVRA_CHI_M23, EVRA_CHI_XX33, EVRA_CHI_XY33, EVRA_CHI_XZ33, EVRA_CHI_YY33,
    EVRA_CHI_YZ33, EVRA_CHI_ZZ33, EVRA_CHI_MX33, EVRA_CHI_MY33, EVRA_CHI_MZ33, EVRA_CHI_M33,
    EVRA_CHI_XX14, EVRA_CHI_XY14, EVRA_CHI_XZ14, EVRA_CHI_YY14, EVRA_CHI_YZ14, EVRA_CHI_ZZ14,
    EVRA_CHI_MX14, EVRA_CHI_MY14, EVRA_CHI_MZ14, EVRA_CHI_M14, EVRA_CHI_XX24, EVRA_CHI_XY24,
    EVRA_CHI_XZ24, EVRA_CHI_YY24, EVRA_CHI_YZ24, EVRA_CHI_ZZ24, EVRA_CHI_MX24, EVRA_CHI_MY24,
    EVRA_CHI_MZ24, EVRA_CHI_M24, EVRA_CHI_XX34, EVRA_CHI_XY34, EVRA_CHI_XZ34, EVRA_CHI_YY34,
    EVRA_CHI_YZ34, EVRA_CHI_ZZ34, EVRA_CHI_MX34, EVRA_CHI_MY34, EVRA_CHI_MZ34, EVRA_CHI_M34,
    EVRA_CHI_XX15, EVRA_CHI_XY15, EVRA_CHI_XZ15, EVRA_CHI_YY15, EVRA_CHI_YZ15, EVRA_CHI_ZZ15,
    EVRA_CHI_MX15, EVRA_CHI_MY15, EVRA_CHI_MZ15, EVRA_CHI_M15, EVRA_CHI_XX25, EVRA_CHI_XY25,
    EVRA_CHI_XZ25, EVRA_CHI_YY25, EVRA_CHI_YZ25, EVRA_CHI_ZZ25, EVRA_CHI_MX25, EVRA_CHI_MY25,
    EVRA_CHI_MZ25, EVRA_CHI_M25, EVRA_CHI_XX35, EVRA_CHI_XY35, EVRA_CHI_XZ35, EVRA_CHI_YY35,
    EVRA_CHI_YZ35, EVRA_CHI_ZZ35, EVRA_CHI_MX35, EVRA_CHI_MY35, EVRA_CHI_MZ35, EVRA_CHI_M35,
    EVRA_CHI_XX16, EVRA_CHI_XY16, EVRA_CHI_XZ16, EVRA_CHI_YY16, EVRA_CHI_YZ16, EVRA_CHI_ZZ16,
    EVRA_CHI_MX16, EVRA_CHI_MY16, EVRA_CHI_MZ16, EVRA_CHI_M16, EVRA_CHI_XX26, EVRA_CHI_XY26,
    EVRA_CHI_XZ26, EVRA_CHI_YY26, EVRA_CHI_YZ26, EVRA_CHI_ZZ26, EVRA_CHI_MX26, EVRA_CHI_MY26,
    EVRA_CHI_MZ26, EVRA_CHI_M26, EVRA_CHI_XX36, EVRA_CHI_XY36, EVRA_CHI_XZ36, EVRA_CHI_YY36,
    EVRA_CHI_YZ36, EVRA_CHI_ZZ36, EVRA_CHI_MX36, EVRA_CHI_MY36, EVRA_CHI_MZ36, EVRA_CHI_M36
};

/* beta: base parameters, columns of evra_base_regressor
 *
 *    0  XXPR = XXP + RP**2*sin(phi1)**2*M31 + RP**2*sin(phi2)**2*M32 + RP**2*sin(phi3)**2*M33 +
 *         RP**2*sin(phi4)**2*M34 + RP**2*sin(phi5)**2*M35 + RP**2*sin(phi6)**2*M36  [kg m2]
 *    1  XYPR = XYP - RP**2*sin(phi1)*cos(phi1)*M31 - RP**2*sin(phi2)*cos(phi2)*M32 -
 *         RP**2*sin(phi3)*cos(phi3)*M33 - RP**2*sin(phi4)*cos(phi4)*M34 -
 *         RP**2*sin(phi5)*cos(phi5)*M35 - RP**2*sin(phi6)*cos(phi6)*M36  [kg m2]
 *    2  XZP  [kg m2]
 *    3  YYPR = YYP + RP**2*cos(phi1)**2*M31 + RP**2*cos(phi2)**2*M32 + RP**2*cos(phi3)**2*M33 +
 *         RP**2*cos(phi4)**2*M34 + RP**2*cos(phi5)**2*M35 + RP**2*cos(phi6)**2*M36  [kg m2]
 *    4  YZP  [kg m2]
 *    5  ZZPR = ZZP + RP**2*M31 + RP**2*M32 + RP**2*M33 + RP**2*M34 + RP**2*M35 + RP**2*M36  [kg
 *         m2]
 *    6  MXPR = MXP + RP*cos(phi1)*M31 + RP*cos(phi2)*M32 + RP*cos(phi3)*M33 + RP*cos(phi4)*M34 +
 *         RP*cos(phi5)*M35 + RP*cos(phi6)*M36  [kg m]
 *    7  MYPR = MYP + RP*sin(phi1)*M31 + RP*sin(phi2)*M32 + RP*sin(phi3)*M33 + RP*sin(phi4)*M34 +
 *         RP*sin(phi5)*M35 + RP*sin(phi6)*M36  [kg m]
 *    8  MZP  [kg m]
 *    9  MPR = MP + M31 + M32 + M33 + M34 + M35 + M36  [kg]
 *   10  Ms1  [kg]
 *   11  Ms2R = Ms2 + M11 + M21 + M12 + M22 + M13 + M23 + M14 + M24 + M15 + M25 + M16 + M26  [kg]
 *   12  ZZ11R = ZZ11 + YY21 + ZZ31  [kg m2]
 *   13  MX11  [kg m]
 *   14  MY11R = MY11 - MZ21  [kg m]
 *   15  XX21R = XX21 - YY21 + XX31 - ZZ31  [kg m2]
 *   16  XY21R = XY21 - XZ31  [kg m2]
 *   17  XZ21R = XZ21 + XY31  [kg m2]
 *   18  YZ21R = YZ21 - YZ31  [kg m2]
 *   19  ZZ21R = ZZ21 + YY31  [kg m2]
 *   20  MX21  [kg m]
 *   21  MY21  [kg m]
 *   22  MX31  [kg m]
 *   23  MY31  [kg m]
 *   24  MZ31  [kg m]
 *   25  ZZ12R = ZZ12 + YY22 + ZZ32  [kg m2]
 *   26  MX12  [kg m]
 *   27  MY12R = MY12 - MZ22  [kg m]
 *   28  XX22R = XX22 - YY22 + XX32 - ZZ32  [kg m2]
 *   29  XY22R = XY22 - XZ32  [kg m2]
 *   30  XZ22R = XZ22 + XY32  [kg m2]
 *   31  YZ22R = YZ22 - YZ32  [kg m2]
 *   32  ZZ22R = ZZ22 + YY32  [kg m2]
 *   33  MX22  [kg m]
 *   34  MY22  [kg m]
 *   35  MX32  [kg m]
 *   36  MY32  [kg m]
 *   37  MZ32  [kg m]
 *   38  ZZ13R = ZZ13 + YY23 + ZZ33  [kg m2]
 *   39  MX13  [kg m]
 *   40  MY13R = MY13 - MZ23  [kg m]
 *   41  XX23R = XX23 - YY23 + XX33 - ZZ33  [kg m2]
 *   42  XY23R = XY23 - XZ33  [kg m2]
 *   43  XZ23R = XZ23 + XY33  [kg m2]
 *   44  YZ23R = YZ23 - YZ33  [kg m2]
 *   45  ZZ23R = ZZ23 + YY33  [kg m2]
 *   46  MX23  [kg m]
 *   47  MY23  [kg m]
 *   48  MX33  [kg m]
 *   49  MY33  [kg m]
 *   50  MZ33  [kg m]
 *   51  ZZ14R = ZZ14 + YY24 + ZZ34  [kg m2]
 *   52  MX14  [kg m]
 *   53  MY14R = MY14 - MZ24  [kg m]
 *   54  XX24R = XX24 - YY24 + XX34 - ZZ34  [kg m2]
 *   55  XY24R = XY24 - XZ34  [kg m2]
 *   56  XZ24R = XZ24 + XY34  [kg m2]
 *   57  YZ24R = YZ24 - YZ34  [kg m2]
 *   58  ZZ24R = ZZ24 + YY34  [kg m2]
 *   59  MX24  [kg m]
 *   60  MY24  [kg m]
 *   61  MX34  [kg m]
 *   62  MY34  [kg m]
 *   63  MZ34  [kg m]
 *   64  ZZ15R = ZZ15 + YY25 + ZZ35  [kg m2]
 *   65  MX15  [kg m]
 *   66  MY15R = MY15 - MZ25  [kg m]
 *   67  XX25R = XX25 - YY25 + XX35 - ZZ35  [kg m2]
 *   68  XY25R = XY25 - XZ35  [kg m2]
 *   69  XZ25R = XZ25 + XY35  [kg m2]
 *   70  YZ25R = YZ25 - YZ35  [kg m2]
 *   71  ZZ25R = ZZ25 + YY35  [kg m2]
 *   72  MX25  [kg m]
 *   73  MY25  [kg m]
 *   74  MX35  [kg m]
 *   75  MY35  [kg m]
 *   76  MZ35  [kg m]
 *   77  ZZ16R = ZZ16 + YY26 + ZZ36  [kg m2]
 *   78  MX16  [kg m]
 *   79  MY16R = MY16 - MZ26  [kg m]
 *   80  XX26R = XX26 - YY26 + XX36 - ZZ36  [kg m2]
 *   81  XY26R = XY26 - XZ36  [kg m2]
 *   82  XZ26R = XZ26 + XY36  [kg m2]
 *   83  YZ26R = YZ26 - YZ36  [kg m2]
 *   84  ZZ26R = ZZ26 + YY36  [kg m2]
 *   85  MX26  [kg m]
 *   86  MY26  [kg m]
 *   87  MX36  [kg m]
 *   88  MY36  [kg m]
 *   89  MZ36  [kg m]
 */
enum {
    EVRA_BETA_XXPR, EVRA_BETA_XYPR, EVRA_BETA_XZP, EVRA_BETA_YYPR, EVRA_BETA_YZP, EVRA_BETA_ZZPR,
    EVRA_BETA_MXPR, EVRA_BETA_MYPR, EVRA_BETA_MZP, EVRA_BETA_MPR, EVRA_BETA_Ms1, EVRA_BETA_Ms2R,
    EVRA_BETA_ZZ11R, EVRA_BETA_MX11, EVRA_BETA_MY11R, EVRA_BETA_XX21R, EVRA_BETA_XY21R,
    EVRA_BETA_XZ21R, EVRA_BETA_YZ21R, EVRA_BETA_ZZ21R, EVRA_BETA_MX21, EVRA_BETA_MY21,
    EVRA_BETA_MX31, EVRA_BETA_MY31, EVRA_BETA_MZ31, EVRA_BETA_ZZ12R, EVRA_BETA_MX12,
    EVRA_BETA_MY12R, EVRA_BETA_XX22R, EVRA_BETA_XY22R, EVRA_BETA_XZ22R, EVRA_BETA_YZ22R,
    EVRA_BETA_ZZ22R, EVRA_BETA_MX22, EVRA_BETA_MY22, EVRA_BETA_MX32, EVRA_BETA_MY32, EVRA_BETA_MZ32,
    EVRA_BETA_ZZ13R, EVRA_BETA_MX13, EVRA_BETA_MY13R, EVRA_BETA_XX23R, EVRA_BETA_XY23R,
    EVRA_BETA_XZ23R, EVRA_BETA_YZ23R, EVRA_BETA_ZZ23R, EVRA_BETA_MX23, EVRA_BETA_MY23,
    EVRA_BETA_MX33, EVRA_BETA_MY33, EVRA_BETA_MZ33, EVRA_BETA_ZZ14R, EVRA_BETA_MX14,
    EVRA_BETA_MY14R, EVRA_BETA_XX24R, EVRA_BETA_XY24R, EVRA_BETA_XZ24R, EVRA_BETA_YZ24R,
    EVRA_BETA_ZZ24R, EVRA_BETA_MX24, EVRA_BETA_MY24, EVRA_BETA_MX34, EVRA_BETA_MY34, EVRA_BETA_MZ34,
    EVRA_BETA_ZZ15R, EVRA_BETA_MX15, EVRA_BETA_MY15R, EVRA_BETA_XX25R, EVRA_BETA_XY25R,
    EVRA_BETA_XZ25R, EVRA_BETA_YZ25R, EVRA_BETA_ZZ25R, EVRA_BETA_MX25, EVRA_BETA_MY25,
    EVRA_BETA_MX35, EVRA_BETA_MY35, EVRA_BETA_MZ35, EVRA_BETA_ZZ16R, EVRA_BETA_MX16,
    EVRA_BETA_MY16R, EVRA_BETA_XX26R, EVRA_BETA_XY26R, EVRA_BETA_XZ26R, EVRA_BETA_YZ26R,
    EVRA_BETA_ZZ26R, EVRA_BETA_MX26, EVRA_BETA_MY26, EVRA_BETA_MX36, EVRA_BETA_MY36, EVRA_BETA_MZ36
};

/* u: free variables of the opened tree: Px, Py, Pz, Pa, Pb, P, s1, s2, 11, 21, 31, 12, 22, 32, 13, 23, 33, 14, 24, 34, 15, 25, 35, 16, 26, 36
 *
 * Functions that close the loops return a status: 0 done; 1 the loops cannot be closed on the
 * straight way from the home posture to these values; 2 singular posture; 3 an input is not finite,
 * or an output would not be; 4 these values are so far that EVRA_MAX_CLOSURE_EVALUATIONS
 * evaluations of the closure equations do not do: no call makes more. Outputs are NaN unless it is 0. The assembly
 * mode is that of the home posture.
 */

/* Tells whether this code belongs to a manifest. */
const char *evra_signature(void);

/* Regressor of the standard parameters.
 *
 * tau = phi chi
 *
 * q      8        joint positions [m]
 * qd     8        joint velocities [m/s]
 * qdd    8        joint accelerations [m/s2]
 * phi    8 x 210  torque per unit of each standard parameter, row-major [SI]
 */
int evra_regressor(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                   const double qdd[EVRA_JOINTS], double phi[8 * 210]);

/* Regressor of the base parameters.
 *
 * tau = phi beta
 *
 * q      8        joint positions [m]
 * qd     8        joint velocities [m/s]
 * qdd    8        joint accelerations [m/s2]
 * phi    8 x 90   torque per unit of each base parameter, row-major [SI]
 */
int evra_base_regressor(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                        const double qdd[EVRA_JOINTS], double phi[8 * 90]);

/* Torques that move the closed robot so.
 *
 * tau = M qdd + c + g + f
 *
 * q      8        joint positions [m]
 * qd     8        joint velocities [m/s]
 * qdd    8        joint accelerations [m/s2]
 * beta   90       base parameters [SI]
 * tau    8        joint torques or forces [N]
 */
int evra_inverse_dynamics(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                          const double qdd[EVRA_JOINTS], const double beta[EVRA_BASE_PARAMETERS],
                          double tau[EVRA_JOINTS]);

/* Torques that hold the robot still, without friction.
 *
 * g(q) = tau(q, 0, 0) without effects
 *
 * q      8        joint positions [m]
 * beta   90       base parameters [SI]
 * tau    8        joint torques or forces [N]
 */
int evra_gravity(const double q[EVRA_JOINTS], const double beta[EVRA_BASE_PARAMETERS],
                 double tau[EVRA_JOINTS]);

/* Coriolis and centripetal torques.
 *
 * c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets
 *
 * q      8        joint positions [m]
 * qd     8        joint velocities [m/s]
 * beta   90       base parameters [SI]
 * tau    8        joint torques or forces [N]
 */
int evra_coriolis(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                  const double beta[EVRA_BASE_PARAMETERS], double tau[EVRA_JOINTS]);

/* Torques of all effects but rotor inertias: friction, offsets.
 *
 * f(q, qd)
 *
 * q      8        joint positions [m]
 * qd     8        joint velocities [m/s]
 * beta   90       base parameters [SI]
 * tau    8        joint torques or forces [N]
 */
int evra_friction(const double q[EVRA_JOINTS], const double qd[EVRA_JOINTS],
                  const double beta[EVRA_BASE_PARAMETERS], double tau[EVRA_JOINTS]);

/* Inertia matrix, rotor inertias included; symmetric.
 *
 * tau = M(q) qdd + ...
 *
 * q      8        joint positions [m]
 * beta   90       base parameters [SI]
 * M      8 x 8    inertia matrix, row-major [kg m2, kg m or kg]
 */
int evra_inertia_matrix(const double q[EVRA_JOINTS], const double beta[EVRA_BASE_PARAMETERS],
                        double M[8 * 8]);

/* Pose of the frame of every moving row of the table.
 *
 * x0 = R x + p with T = [R | p], for a point x of the frame
 *
 * q      8          joint positions [m]
 * T      26 x 3 x 4 poses [R | p] of rows Px, Py, Pz, Pa, Pb, P, s1, s2, 11, 21, 31, 12, 22, 32,
 *                   13, 23, 33, 14, 24, 34, 15, 25, 35, 16, 26, 36 in frame 0, row-major [1 | m]
 */
int evra_forward_kinematics(const double q[EVRA_JOINTS], double T[26 * 3 * 4]);

/* Closed posture, on a straight way from home.
 *
 * f(u) = 0
 *
 * q      8        joint positions [m]
 * u      26       free variables of the opened tree [rad or m]
 */
int evra_close(const double q[EVRA_JOINTS], double u[26]);

/* Closed posture, on a straight way from another one, such as the last.
 *
 * f(u) = 0
 *
 * q      8        joint positions [m]
 * start  26       a closed posture to start from [rad or m]
 * u      26       free variables of the opened tree [rad or m]
 */
int evra_close_from(const double q[EVRA_JOINTS], const double start[26], double u[26]);

/* Speeds of the free variables; rows of the platform are its Jacobian.
 *
 * ud = G qd
 *
 * q      8        joint positions [m]
 * G      26 x 8   d u / d q, row-major [SI]
 */
int evra_coupling(const double q[EVRA_JOINTS], double G[26 * 8]);

/* Base parameters from standard ones: the grouping relations.
 *
 * beta = K chi
 *
 * chi    210      standard parameters [SI]
 * beta   90       base parameters [SI]
 */
void evra_base_parameters(const double chi[EVRA_STANDARD_PARAMETERS],
                          double beta[EVRA_BASE_PARAMETERS]);

/* Regressor of the base parameters.
 *
 * f = phi beta
 *
 * x      8        positions of the platform: Px, Py, Pz, Pa, Pb, P, s1, s2 [m or rad]
 * xd     8        their velocities [m/s or rad/s]
 * xdd    8        their accelerations [m/s2 or rad/s2]
 * phi    8 x 90   torque per unit of each base parameter, row-major [SI]
 */
int evra_platform_base_regressor(const double x[8], const double xd[8], const double xdd[8],
                                 double phi[8 * 90]);

/* Torques that move the closed robot so.
 *
 * f = M xdd + c + g + f
 *
 * x      8        positions of the platform: Px, Py, Pz, Pa, Pb, P, s1, s2 [m or rad]
 * xd     8        their velocities [m/s or rad/s]
 * xdd    8        their accelerations [m/s2 or rad/s2]
 * beta   90       base parameters [SI]
 * f      8        forces and torques along x [N or N m]
 */
int evra_platform_inverse_dynamics(const double x[8], const double xd[8], const double xdd[8],
                                   const double beta[EVRA_BASE_PARAMETERS], double f[8]);

/* Closed posture, on a straight way from home.
 *
 * f(u) = 0
 *
 * x      8        positions of the platform: Px, Py, Pz, Pa, Pb, P, s1, s2 [m or rad]
 * u      26       free variables of the opened tree [rad or m]
 */
int evra_platform_close(const double x[8], double u[26]);

/* Closed posture, on a straight way from another one, such as the last.
 *
 * f(u) = 0
 *
 * x      8        positions of the platform: Px, Py, Pz, Pa, Pb, P, s1, s2 [m or rad]
 * start  26       a closed posture to start from [rad or m]
 * u      26       free variables of the opened tree [rad or m]
 */
int evra_platform_close_from(const double x[8], const double start[26], double u[26]);

/* Speeds of the free variables; rows of the platform are its Jacobian.
 *
 * ud = G xd
 *
 * x      8        positions of the platform: Px, Py, Pz, Pa, Pb, P, s1, s2 [m or rad]
 * G      26 x 8   d u / d x, row-major [SI]
 */
int evra_platform_coupling(const double x[8], double G[26 * 8]);

/* A closed posture and what solved it, and a controller's state: members are the library's. */
struct evra_posture {
    double u[26];      /* free variables */
    double ud[26];     /* their speeds */
    double gamma[26];  /* their accelerations at qdd = 0 */
    double G[208];
    double qd[8];
    modeler_kept kept;
    int places[62];
    double numbers[1622];
};

struct evra_state {
    struct evra_posture at;
    int closed; /* by the last call of evra_state; memory of zeros is no state yet */
    int status;
    int rated; /* `rate` holds dG/dt */
    double rate[208];
    double rows[2340];
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
int evra_state(const double *q, const double *qd, const double *previous,
    struct evra_state *state);

/* The same with at most `evaluations` of the closure equations, and never more than
 * EVRA_MAX_CLOSURE_EVALUATIONS: status 4 if these do not do. */
int evra_state_with_bound(const double *q, const double *qd, const double *previous,
    int evaluations, struct evra_state *state);
#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
int evra_base_regressor_at(struct evra_state *state, const double qdd[EVRA_JOINTS],
                           double phi[8 * 90]);
int evra_inverse_dynamics_at(struct evra_state *state, const double qdd[EVRA_JOINTS],
                             const double beta[EVRA_BASE_PARAMETERS], double tau[EVRA_JOINTS]);
int evra_gravity_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                    double tau[EVRA_JOINTS]);
int evra_coriolis_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                     double tau[EVRA_JOINTS]);
int evra_friction_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                     double tau[EVRA_JOINTS]);
int evra_inertia_matrix_at(struct evra_state *state, const double beta[EVRA_BASE_PARAMETERS],
                           double M[8 * 8]);
int evra_forward_kinematics_at(struct evra_state *state, double T[26 * 3 * 4]);
int evra_coupling_at(struct evra_state *state, double G[26 * 8]);

/* dG/dt, as G: udd = G qdd + dG/dt qd. `rate` may be NULL: it is kept in the state. */
int evra_coupling_rate_at(struct evra_state *state, double *rate);

#ifdef __cplusplus
}
#endif

#endif
