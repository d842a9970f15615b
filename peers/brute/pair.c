/* The impact pair, x = -C cos t prescribed and an absorber between walls, stepped and bisected: which motions many starts
   end in. Shares nothing with the program.

   cc -O2 -o pair pair.c -lm
   pair R_FROM R_TO R_STEP C_FROM C_TO C_STEP STARTS    prints r, C, then each motion as starts:S:K:impacts-per-period:spread

   S and K are averages over 720 periods, from impulses: the first harmonic of y is that of -y''. Two starts are of one motion
   if their averages differ by at most 2e-3 and what the two halves of the time differ by. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define TAU 6.283185307179586
enum { SETTLE = 600, COUNT = 720, MOST = 64 };

static double amplitude, restitution;
static double place(double t) { return -amplitude * cos(t); }
static double speed(double t) { return amplitude * sin(t); }

typedef struct { double s, k, z, spread; int ok; } motion;

/* Roots of how far inside the absorber is, by steps of a hundredth of a radian at most. */
static motion follow(double w, double v) {
    double t0 = 0, y0 = place(0) - w, sums[2][3] = {{0}};
    double end = TAU * (SETTLE + COUNT), begin = TAU * SETTLE, half = TAU * (SETTLE + COUNT / 2);
    double touching = 0; /* the wall the flight starts from */
    long impacts = 0;
    double t = 0;
    while (t < end) {
        double step = 0.01;
        if (touching) {
            double leave = touching * (v - speed(t0)), pull = touching * amplitude * cos(t0);
            if (pull > 0 && leave < 1e-11 * amplitude) { /* rests until the wall recedes */
                double until = (floor(t0 / M_PI + 0.5) + 0.5) * M_PI;
                /* its momentum changes with the wall's, and so do the harmonics */
                for (int n = 0; n < 200; n++) {
                    double a = t0 + (until - t0) * n / 200, b = t0 + (until - t0) * (n + 1) / 200, m = 0.5 * (a + b);
                    if (m > begin) {
                        double dv = speed(b) - speed(a);
                        sums[m > half][0] += dv * sin(m); sums[m > half][1] -= dv * cos(m);
                    }
                }
                t = t0 = until; y0 = place(t) - touching; v = speed(t);
                /* free from here, with the wall receding */
                t += 1e-3; touching = 0; continue;
            }
            if (pull > 0 && 2 * leave / pull < 8 * step) step = leave / pull / 4;
        }
        double wall;
        for (;;) {
            double next = t + step, gap = place(next) - (y0 + v * (next - t0));
            if (fabs(gap) > 1) { wall = gap > 0 ? 1 : -1; break; }
            t = next;
            if (t > end) break;
        }
        if (t > end) break;
        double low = t, high = t + step;
        for (int n = 0; n < 60; n++) {
            double m = 0.5 * (low + high);
            if (wall * (place(m) - (y0 + v * (m - t0))) > 1) high = m; else low = m;
        }
        double after = (1 + restitution) * speed(high) - restitution * v;
        if (high > begin) {
            int h = high > half;
            sums[h][0] += (after - v) * sin(high); sums[h][1] -= (after - v) * cos(high); sums[h][2] += 1;
        }
        t = t0 = high; y0 = place(t) - wall; v = after; touching = wall;
        if (++impacts > 400L * (SETTLE + COUNT)) return (motion){0};
    }
    double f = 1 / (M_PI * COUNT);
    double s = (sums[0][0] + sums[1][0]) * f, k = (sums[0][1] + sums[1][1]) * f;
    double ds = fabs(sums[0][0] - sums[1][0]) * f, dk = fabs(sums[0][1] - sums[1][1]) * f;
    return (motion){s, k, (sums[0][2] + sums[1][2]) / COUNT, ds > dk ? ds : dk, 1};
}

int main(int n, char **a) {
    if (n < 8) return 2;
    double g[7];
    for (int i = 0; i < 7; i++) g[i] = atof(a[i + 1]);
    int starts = (int)g[6], rs = (int)floor((g[1] - g[0]) / g[2] + 0.5), cs = (int)floor((g[4] - g[3]) / g[5] + 0.5);
    for (int i = 0; i <= rs; i++)
        for (int j = 0; j <= cs; j++) {
            restitution = g[0] + i * g[2]; amplitude = g[3] + j * g[5];
            motion found[MOST]; int of[MOST], kinds = 0;
            for (int m = 0; m < starts; m++) {
                /* evenly spread: multiples of roots of primes */
                double p = fmod(0.5 + m * sqrt(2.0), 1), q = fmod(0.5 + m * sqrt(3.0), 1);
                motion one = follow(2 * p - 1, (6 * q - 3) * amplitude);
                if (!one.ok) continue;
                int c = 0;
                for (; c < kinds; c++) {
                    double wide = 2e-3 + one.spread + found[c].spread;
                    if (fabs(one.s - found[c].s) < wide && fabs(one.k - found[c].k) < wide) break;
                }
                if (c == kinds && kinds < MOST) { found[kinds] = one; of[kinds++] = 0; }
                if (c < MOST) of[c]++;
            }
            printf("%.4g %.5g", restitution, amplitude);
            for (int c = 0; c < kinds; c++)
                printf(" %d:%.5f:%.5f:%.4f:%.1e", of[c], found[c].s, found[c].k, found[c].z, found[c].spread);
            printf("\n");
            fflush(stdout);
        }
    return 0;
}
