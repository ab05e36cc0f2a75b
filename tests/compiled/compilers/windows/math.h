double sin(double);
double cos(double);
double tan(double);
double sqrt(double);
double fabs(double);
double exp(double);
double tanh(double);
double pow(double, double);
double fmin(double, double);
double fmax(double, double);
double hypot(double, double);
double copysign(double, double);

#define isnan(x) ((x) != (x))
#define isfinite(x) ((x) - (x) == 0)
#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
