/* Orthoglide, three translations (Guegan, Khalil, Lemoine 2003)
 *
 * Functions of orthoglide_2003.h.
 * Emitted by modeler, which writes over a file that was edited only with --force.
 */
#include "orthoglide_2003.h"

#include <math.h>

#include "modeler_runtime.h"
#include "modeler_sincos.h"
#include "orthoglide_2003_tree.h"

/* Geometry. To use another value, compile with e.g. -DORTHOGLIDE_2003_GEO_g=9.81
 * or any constant expression of C; mind that 1/2 is 0 there, 1.0/2 is not. */
#ifndef ORTHOGLIDE_2003_GEO_g
#define ORTHOGLIDE_2003_GEO_g 9.81
#endif
#ifndef ORTHOGLIDE_2003_GEO_D41
#define ORTHOGLIDE_2003_GEO_D41 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D42
#define ORTHOGLIDE_2003_GEO_D42 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_D43
#define ORTHOGLIDE_2003_GEO_D43 0.31
#endif
#ifndef ORTHOGLIDE_2003_GEO_b3
#define ORTHOGLIDE_2003_GEO_b3 (-0.04)
#endif
#ifndef ORTHOGLIDE_2003_GEO_b7
#define ORTHOGLIDE_2003_GEO_b7 0.04
#endif
#ifndef ORTHOGLIDE_2003_GEO_a
#define ORTHOGLIDE_2003_GEO_a 0.6
#endif
#ifndef ORTHOGLIDE_2003_GEO_d6
#define ORTHOGLIDE_2003_GEO_d6 0.1
#endif

static const double orthoglide_2003_geo_g = ORTHOGLIDE_2003_GEO_g;
static const double orthoglide_2003_geo_D41 = ORTHOGLIDE_2003_GEO_D41;
static const double orthoglide_2003_geo_D42 = ORTHOGLIDE_2003_GEO_D42;
static const double orthoglide_2003_geo_D43 = ORTHOGLIDE_2003_GEO_D43;

/* Regressor of the standard parameters.
 * 99 additions, 172 multiplications. */
void orthoglide_2003_tree_regressor(const double *q, const double *qd, const double *qdd,
                                    double *MODELER_RESTRICT phi)
{
    for (int i = 0; i < 1956; i++)
        phi[i] = 0.0;

    double s6, c6;
    modeler_sincos(q[6], &s6, &c6);
    double s7, c7;
    modeler_sincos(q[7], &s7, &c7);
    double s8, c8;
    modeler_sincos(q[8], &s8, &c8);
    double s9, c9;
    modeler_sincos(q[9], &s9, &c9);
    double s10, c10;
    modeler_sincos(q[10], &s10, &c10);
    double s11, c11;
    modeler_sincos(q[11], &s11, &c11);

    phi[0] = qdd[0];
    phi[163] = qdd[1] - orthoglide_2003_geo_g;
    phi[326] = qdd[2];
    phi[499] = qdd[3];
    phi[500] = qdd[3];
    phi[501] = qd[3];
    phi[502] = (double)((qd[3] > 0.0) - (qd[3] < 0.0));
    phi[503] = 1.0;
    phi[676] = qdd[4];
    phi[677] = qdd[4];
    phi[678] = qd[4];
    phi[679] = (double)((qd[4] > 0.0) - (qd[4] < 0.0));
    phi[680] = 1.0;
    const double t1 = qdd[5] - orthoglide_2003_geo_g;
    phi[853] = t1;
    phi[854] = qdd[5];
    phi[855] = qd[5];
    phi[856] = (double)((qd[5] > 0.0) - (qd[5] < 0.0));
    phi[857] = 1.0;
    phi[1026] = qdd[6];
    const double t2 = qd[6]*qd[6];
    const double t3 = s6*t2 - c6*qdd[6];
    phi[538] = t3;
    const double t4 = c6*qdd[3];
    phi[1027] = -t4;
    const double t5 = s6*qdd[6] + c6*t2;
    phi[539] = t5;
    const double t6 = s6*qdd[3];
    phi[1028] = t6;
    phi[541] = qdd[3];
    const double t7 = s7*qdd[6];
    const double t8 = c7*qd[6];
    const double t9 = qd[7]*t8;
    const double t10 = t7 + t9;
    const double t11 = s7*qd[6];
    const double t12 = qd[7]*t11;
    const double t13 = c7*t12;
    const double t14 = s7*t10 + t13;
    phi[1031] = t14;
    const double t15 = t11*t8;
    phi[1194] = -t15;
    const double t16 = c7*qdd[6];
    const double t17 = t16 - t12;
    const double t18 = t12 - t17;
    const double t19 = t9 + t10;
    const double t20 = s7*t18 - c7*t19;
    phi[1032] = -t20;
    const double t21 = qd[7]*qd[7];
    const double t22 = t8*t8 + t21;
    const double t23 = t11*t11 + t21;
    const double t24 = t22 - t23;
    phi[1195] = -t24;
    const double t25 = qdd[7] + t15;
    const double t26 = s7*t25 - c7*(t2 - t22);
    phi[1033] = -t26;
    phi[1196] = -t7;
    const double t27 = c7*t17 - t13;
    phi[1034] = t27;
    phi[1197] = t15;
    const double t28 = qdd[7] - t15;
    const double t29 = s7*(t2 - t23) + c7*t28;
    phi[1035] = -t29;
    phi[1198] = -t16;
    phi[1199] = qdd[7];
    const double t30 = s6*c7;
    const double t31 = s6*s7;
    const double t32 = t30*t22 + t31*t25 + c6*t18;
    phi[548] = t32;
    const double t33 = c7*t4;
    phi[1037] = -t33;
    const double t34 = orthoglide_2003_geo_g*c7 + s7*t6;
    phi[1200] = t34;
    const double t35 = t30*t28 - t31*t23 + c6*t19;
    phi[549] = t35;
    const double t36 = s7*t4;
    phi[1038] = t36;
    const double t37 = c7*t6 - orthoglide_2003_geo_g*s7;
    phi[1201] = t37;
    phi[550] = t5;
    phi[1039] = t6;
    phi[551] = qdd[3];
    phi[1044] = qdd[6];
    phi[558] = t3;
    const double t38 = t4 + orthoglide_2003_geo_D41*t18;
    const double t39 = orthoglide_2003_geo_D41*c7;
    phi[1047] = t39*qdd[6] - t38;
    const double t40 = orthoglide_2003_geo_D41*s7;
    phi[1210] = t40*t2;
    phi[560] = t5;
    const double t41 = t37 + orthoglide_2003_geo_D41*t22;
    const double t42 = t34 + orthoglide_2003_geo_D41*t25;
    const double t43 = c7*t41 + s7*t42;
    phi[1049] = t43 - t39*t2;
    phi[1212] = t40*qdd[6];
    phi[561] = s6*t43 + c6*t38;
    phi[1050] = -t39*t38;
    phi[1213] = t40*t43 + t39*(c7*t42 - s7*t41);
    phi[1051] = t14;
    phi[1214] = -t15;
    phi[1052] = -t20;
    phi[1215] = -t24;
    phi[1053] = -t26;
    phi[1216] = -t7;
    phi[1054] = t27;
    phi[1217] = t15;
    phi[1055] = -t29;
    phi[1218] = -t16;
    phi[1219] = qdd[7];
    phi[568] = t32;
    phi[1057] = -t33;
    phi[1220] = t34;
    phi[569] = t35;
    phi[1058] = t36;
    phi[1221] = t37;
    phi[570] = t5;
    phi[1059] = t6;
    phi[571] = qdd[3];
    phi[1392] = qdd[8];
    const double t44 = qd[8]*qd[8];
    const double t45 = s8*t44 - c8*qdd[8];
    phi[741] = t45;
    const double t46 = c8*qdd[4] - orthoglide_2003_geo_g*s8;
    phi[1393] = -t46;
    const double t47 = s8*qdd[8] + c8*t44;
    phi[742] = t47;
    const double t48 = orthoglide_2003_geo_g*c8 + s8*qdd[4];
    phi[1394] = t48;
    phi[744] = qdd[4];
    const double t49 = s9*qdd[8];
    const double t50 = c9*qd[8];
    const double t51 = qd[9]*t50;
    const double t52 = t49 + t51;
    const double t53 = s9*qd[8];
    const double t54 = qd[9]*t53;
    const double t55 = c9*t54;
    const double t56 = s9*t52 + t55;
    phi[1397] = t56;
    const double t57 = t53*t50;
    phi[1560] = -t57;
    const double t58 = c9*qdd[8];
    const double t59 = t58 - t54;
    const double t60 = t54 - t59;
    const double t61 = t51 + t52;
    const double t62 = s9*t60 - c9*t61;
    phi[1398] = -t62;
    const double t63 = qd[9]*qd[9];
    const double t64 = t50*t50 + t63;
    const double t65 = t53*t53 + t63;
    const double t66 = t64 - t65;
    phi[1561] = -t66;
    const double t67 = qdd[9] + t57;
    const double t68 = s9*t67 - c9*(t44 - t64);
    phi[1399] = -t68;
    phi[1562] = -t49;
    const double t69 = c9*t59 - t55;
    phi[1400] = t69;
    phi[1563] = t57;
    const double t70 = qdd[9] - t57;
    const double t71 = s9*(t44 - t65) + c9*t70;
    phi[1401] = -t71;
    phi[1564] = -t58;
    phi[1565] = qdd[9];
    const double t72 = s8*c9;
    const double t73 = s8*s9;
    const double t74 = t72*t64 + t73*t67 + c8*t60;
    phi[751] = t74;
    const double t75 = c9*t46;
    phi[1403] = -t75;
    const double t76 = s9*t48;
    phi[1566] = t76;
    const double t77 = t72*t70 - t73*t65 + c8*t61;
    phi[752] = t77;
    const double t78 = s9*t46;
    phi[1404] = t78;
    const double t79 = c9*t48;
    phi[1567] = t79;
    phi[753] = t47;
    phi[1405] = t48;
    phi[754] = qdd[4];
    phi[1410] = qdd[8];
    phi[761] = t45;
    const double t80 = t46 + orthoglide_2003_geo_D42*t60;
    const double t81 = orthoglide_2003_geo_D42*c9;
    phi[1413] = t81*qdd[8] - t80;
    const double t82 = orthoglide_2003_geo_D42*s9;
    phi[1576] = t82*t44;
    phi[763] = t47;
    const double t83 = t79 + orthoglide_2003_geo_D42*t64;
    const double t84 = t76 + orthoglide_2003_geo_D42*t67;
    const double t85 = c9*t83 + s9*t84;
    phi[1415] = t85 - t81*t44;
    phi[1578] = t82*qdd[8];
    phi[764] = s8*t85 + c8*t80;
    phi[1416] = -t81*t80;
    phi[1579] = t82*t85 + t81*(c9*t84 - s9*t83);
    phi[1417] = t56;
    phi[1580] = -t57;
    phi[1418] = -t62;
    phi[1581] = -t66;
    phi[1419] = -t68;
    phi[1582] = -t49;
    phi[1420] = t69;
    phi[1583] = t57;
    phi[1421] = -t71;
    phi[1584] = -t58;
    phi[1585] = qdd[9];
    phi[771] = t74;
    phi[1423] = -t75;
    phi[1586] = t76;
    phi[772] = t77;
    phi[1424] = t78;
    phi[1587] = t79;
    phi[773] = t47;
    phi[1425] = t48;
    phi[774] = qdd[4];
    phi[1758] = qdd[10];
    const double t86 = qd[10]*qd[10];
    const double t87 = s10*t86 - c10*qdd[10];
    phi[944] = t87;
    const double t88 = c10*t1;
    phi[1759] = -t88;
    const double t89 = s10*qdd[10] + c10*t86;
    phi[945] = t89;
    const double t90 = s10*t1;
    phi[1760] = t90;
    phi[947] = t1;
    const double t91 = s11*qdd[10];
    const double t92 = c11*qd[10];
    const double t93 = qd[11]*t92;
    const double t94 = t91 + t93;
    const double t95 = s11*qd[10];
    const double t96 = qd[11]*t95;
    const double t97 = c11*t96;
    const double t98 = s11*t94 + t97;
    phi[1763] = t98;
    const double t99 = t95*t92;
    phi[1926] = -t99;
    const double t100 = c11*qdd[10];
    const double t101 = t100 - t96;
    const double t102 = t96 - t101;
    const double t103 = t93 + t94;
    const double t104 = s11*t102 - c11*t103;
    phi[1764] = -t104;
    const double t105 = qd[11]*qd[11];
    const double t106 = t92*t92 + t105;
    const double t107 = t95*t95 + t105;
    const double t108 = t106 - t107;
    phi[1927] = -t108;
    const double t109 = qdd[11] + t99;
    const double t110 = s11*t109 - c11*(t86 - t106);
    phi[1765] = -t110;
    phi[1928] = -t91;
    const double t111 = c11*t101 - t97;
    phi[1766] = t111;
    phi[1929] = t99;
    const double t112 = qdd[11] - t99;
    const double t113 = s11*(t86 - t107) + c11*t112;
    phi[1767] = -t113;
    phi[1930] = -t100;
    phi[1931] = qdd[11];
    const double t114 = s10*c11;
    const double t115 = s10*s11;
    const double t116 = t114*t106 + t115*t109 + c10*t102;
    phi[954] = t116;
    const double t117 = c11*t88;
    phi[1769] = -t117;
    const double t118 = s11*t90;
    phi[1932] = t118;
    const double t119 = t114*t112 - t115*t107 + c10*t103;
    phi[955] = t119;
    const double t120 = s11*t88;
    phi[1770] = t120;
    const double t121 = c11*t90;
    phi[1933] = t121;
    phi[956] = t89;
    phi[1771] = t90;
    phi[957] = t1;
    phi[1776] = qdd[10];
    phi[964] = t87;
    const double t122 = t88 + orthoglide_2003_geo_D43*t102;
    const double t123 = orthoglide_2003_geo_D43*c11;
    phi[1779] = t123*qdd[10] - t122;
    const double t124 = orthoglide_2003_geo_D43*s11;
    phi[1942] = t124*t86;
    phi[966] = t89;
    const double t125 = t121 + orthoglide_2003_geo_D43*t106;
    const double t126 = t118 + orthoglide_2003_geo_D43*t109;
    const double t127 = c11*t125 + s11*t126;
    phi[1781] = t127 - t123*t86;
    phi[1944] = t124*qdd[10];
    phi[967] = s10*t127 + c10*t122;
    phi[1782] = -t123*t122;
    phi[1945] = t124*t127 + t123*(c11*t126 - s11*t125);
    phi[1783] = t98;
    phi[1946] = -t99;
    phi[1784] = -t104;
    phi[1947] = -t108;
    phi[1785] = -t110;
    phi[1948] = -t91;
    phi[1786] = t111;
    phi[1949] = t99;
    phi[1787] = -t113;
    phi[1950] = -t100;
    phi[1951] = qdd[11];
    phi[974] = t116;
    phi[1789] = -t117;
    phi[1952] = t118;
    phi[975] = t119;
    phi[1790] = t120;
    phi[1953] = t121;
    phi[976] = t89;
    phi[1791] = t90;
    phi[977] = t1;
}
