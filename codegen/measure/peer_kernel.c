/* The law by hand in C, as a peer to be measured against: no guards, components first.

   k = (alpha^2, beta^2, zeta^2, eta^2, iota, gamma, p); rows of n points follow each other.
   POWER 0 is p = 2, 1 writes powers by exp and log, 2 by pow. Compiled with -O3 -march=native and
   -ffast-math, which lets the compiler take the vectorised functions of libmvec. */
#include <math.h>
#include <stddef.h>

#ifndef POWER
#define POWER 1
#endif

/* (gamma^p + q^(p/2))^(-1/p); gp = gamma^p */
static inline double soft(double q, double gp, double p) {
#if POWER == 0
    return 1 / sqrt(gp + q);
#elif POWER == 1
    return exp(-log(gp + exp(0.5 * p * log(q))) / p);
#else
    return pow(gp + pow(q, 0.5 * p), -1 / p);
#endif
}

/* gamma (1 - q^(p/2))^(-1/p), and q^(p/2 - 1)/(1 - q^(p/2)), the weight of the rank-one term */
static inline double steep(double q, double gamma, double p, double *weight) {
#if POWER == 0
    double left = 1 - q;
    *weight = 1 / left;
    return gamma / sqrt(left);
#elif POWER == 1
    double power = exp(0.5 * p * log(q));
    *weight = power / (q * (1 - power));
    return gamma * exp(-log(1 - power) / p);
#else
    double power = pow(q, 0.5 * p);
    *weight = power / (q * (1 - power));
    return gamma * pow(1 - power, -1 / p);
#endif
}

void strains(const double *restrict m, const double *restrict n, const double *restrict k,
             double *restrict u, double *restrict v, ptrdiff_t points) {
    const double aa = 1 / k[0], zz = 1 / k[2], gap = k[1] * k[3] - k[4] * k[4];
    const double c33 = k[3] / gap, c66 = k[1] / gap, c36 = -k[4] / gap, p = k[6];
    const double gp = pow(k[5], p);
#pragma omp simd
    for (ptrdiff_t i = 0; i < points; i++) {
        double m1 = m[i], m2 = m[points + i], m3 = m[2 * points + i];
        double n1 = n[i], n2 = n[points + i], n3 = n[2 * points + i];
        double e3 = c33 * m3 + c36 * n3, e6 = c36 * m3 + c66 * n3;
        double q = aa * (m1 * m1 + m2 * m2) + zz * (n1 * n1 + n2 * n2) + e3 * m3 + e6 * n3;
        double f = soft(q, gp, p);
        u[i] = f * aa * m1;
        u[points + i] = f * aa * m2;
        u[2 * points + i] = f * e3;
        v[i] = f * zz * n1;
        v[points + i] = f * zz * n2;
        v[2 * points + i] = 1 + f * e6;
    }
}

void loads(const double *restrict u, const double *restrict v, const double *restrict k,
           double *restrict m, double *restrict n, ptrdiff_t points) {
    const double a = k[0], b = k[1], z = k[2], h = k[3], c = k[4], gamma = k[5], p = k[6];
#pragma omp simd
    for (ptrdiff_t i = 0; i < points; i++) {
        double u1 = u[i], u2 = u[points + i], u3 = u[2 * points + i];
        double v1 = v[i], v2 = v[points + i], v3 = v[2 * points + i] - 1;
        double s1 = a * u1, s2 = a * u2, s3 = b * u3 + c * v3;
        double s4 = z * v1, s5 = z * v2, s6 = c * u3 + h * v3, weight;
        double q = s1 * u1 + s2 * u2 + s3 * u3 + s4 * v1 + s5 * v2 + s6 * v3;
        double f = steep(q, gamma, p, &weight);
        m[i] = f * s1;
        m[points + i] = f * s2;
        m[2 * points + i] = f * s3;
        n[i] = f * s4;
        n[points + i] = f * s5;
        n[2 * points + i] = f * s6;
    }
}

#define PUT(i_, j_, value) stiff[((i_) * 6 + (j_)) * points + i] = (value)
#define BOTH(i_, j_, value) { double w_ = (value); PUT(i_, j_, w_); PUT(j_, i_, w_); }

/* With m and n null only the stiffness is written. */
static inline void tangent(const double *restrict u, const double *restrict v,
                           const double *restrict k, double *restrict m, double *restrict n,
                           double *restrict stiff, ptrdiff_t points, const int both) {
    const double a = k[0], b = k[1], z = k[2], h = k[3], c = k[4], gamma = k[5], p = k[6];
#pragma omp simd
    for (ptrdiff_t i = 0; i < points; i++) {
        double u1 = u[i], u2 = u[points + i], u3 = u[2 * points + i];
        double v1 = v[i], v2 = v[points + i], v3 = v[2 * points + i] - 1;
        double s1 = a * u1, s2 = a * u2, s3 = b * u3 + c * v3;
        double s4 = z * v1, s5 = z * v2, s6 = c * u3 + h * v3, weight;
        double q = s1 * u1 + s2 * u2 + s3 * u3 + s4 * v1 + s5 * v2 + s6 * v3;
        double f = steep(q, gamma, p, &weight);
        double g = f * weight;
        double g1 = g * s1, g2 = g * s2, g3 = g * s3, g4 = g * s4, g5 = g * s5;
        if (both) {
            m[i] = f * s1;
            m[points + i] = f * s2;
            m[2 * points + i] = f * s3;
            n[i] = f * s4;
            n[points + i] = f * s5;
            n[2 * points + i] = f * s6;
        }
        PUT(0, 0, f * a + g1 * s1);
        BOTH(0, 1, g1 * s2);
        BOTH(0, 2, g1 * s3);
        BOTH(0, 3, g1 * s4);
        BOTH(0, 4, g1 * s5);
        BOTH(0, 5, g1 * s6);
        PUT(1, 1, f * a + g2 * s2);
        BOTH(1, 2, g2 * s3);
        BOTH(1, 3, g2 * s4);
        BOTH(1, 4, g2 * s5);
        BOTH(1, 5, g2 * s6);
        PUT(2, 2, f * b + g3 * s3);
        BOTH(2, 3, g3 * s4);
        BOTH(2, 4, g3 * s5);
        BOTH(2, 5, f * c + g3 * s6);
        PUT(3, 3, f * z + g4 * s4);
        BOTH(3, 4, g4 * s5);
        BOTH(3, 5, g4 * s6);
        PUT(4, 4, f * z + g5 * s5);
        BOTH(4, 5, g5 * s6);
        PUT(5, 5, f * h + g * s6 * s6);
    }
}

void stiffness(const double *restrict u, const double *restrict v, const double *restrict k,
               double *restrict stiff, ptrdiff_t points) {
    tangent(u, v, k, 0, 0, stiff, points, 0);
}

void loads_and_stiffness(const double *restrict u, const double *restrict v,
                         const double *restrict k, double *restrict m, double *restrict n,
                         double *restrict stiff, ptrdiff_t points) {
    tangent(u, v, k, m, n, stiff, points, 1);
}
