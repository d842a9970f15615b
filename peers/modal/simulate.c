/* A structure of three modes with one absorber at its tip, by closed-form modes between impacts, 2,000 steps a period and
   bisection of each contact: shares no code and no method with the engine. Prints the largest displacement of the tip in mm.
   cc -O2 simulate.c -lm && ./a.out FREQUENCY_HZ MODE FORCE_N SEED PERIODS_LEFT_OUT PERIODS */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MODES = 3 };
static const double FREQUENCIES[MODES] = {1.1, 6.894, 19.31}, DAMPING = 0.005, MASS = 30, BALL = 3, CLEARANCE = 2.7e-3,
                    RESTITUTION = 0.3;
static double w[MODES], force[MODES], omega, q[MODES], v[MODES], y, ball;

static double tip(const double *of) { return of[0] + of[1] + of[2]; }

static void advance(double t, double h)
{
    for (int k = 0; k < MODES; k++) {
        double a = w[k] * w[k] - omega * omega, b = 2 * DAMPING * w[k] * omega, size = a * a + b * b;
        double s = force[k] * a / size, c = -force[k] * b / size;
        double x0 = s * sin(omega * t) + c * cos(omega * t), v0 = omega * (s * cos(omega * t) - c * sin(omega * t));
        double x1 = s * sin(omega * (t + h)) + c * cos(omega * (t + h));
        double v1 = omega * (s * cos(omega * (t + h)) - c * sin(omega * (t + h)));
        double x = q[k] - x0, u = v[k] - v0, wd = w[k] * sqrt(1 - DAMPING * DAMPING), e = exp(-DAMPING * w[k] * h);
        double cosine = cos(wd * h), sine = sin(wd * h);
        q[k] = x1 + e * (x * cosine + (u + DAMPING * w[k] * x) / wd * sine);
        v[k] = v1 + e * (u * cosine - (DAMPING * u + w[k] * x) * w[k] / wd * sine);
    }
    y += ball * h;
}

int main(int count, char **of)
{
    if (count != 7) return 2;
    int mode = atoi(of[2]) - 1;
    double periods_out = atof(of[5]), periods = atof(of[6]), peak = 0, t = 0;
    for (int k = 0; k < MODES; k++) w[k] = 2 * M_PI * FREQUENCIES[k];
    omega = 2 * M_PI * atof(of[1]);
    force[mode] = atof(of[3]) / MASS;
    srand(atoi(of[4]));
    double place = CLEARANCE * 1.9 * ((double)rand() / RAND_MAX - 0.5), share = 1.2 * rand() / RAND_MAX;
    double a = w[mode] * w[mode] - omega * omega, b = 2 * DAMPING * w[mode] * omega, size = a * a + b * b;
    q[mode] = -share * force[mode] * b / size;
    v[mode] = share * omega * force[mode] * a / size;
    y = tip(q) + place;
    ball = tip(v);
    double step = 2 * M_PI / omega / 2000;
    long steps = (long)((periods_out + periods) * 2000), first = (long)(periods_out * 2000);
    for (long i = 0; i < steps; i++) {
        double left = step;
        /* So many contacts in a step are of chatter, whose rest is lost. */
        for (int contacts = 0; left > 0 && contacts < 100; contacts++) {
            double q0[MODES], v0[MODES], y0 = y;
            for (int k = 0; k < MODES; k++) q0[k] = q[k], v0[k] = v[k];
            advance(t, left);
            if (fabs(tip(q) - y) <= CLEARANCE) break;
            double inside = 0, outside = left;
            for (int halved = 0; halved <= 60; halved++) {
                double middle = halved < 60 ? 0.5 * (inside + outside) : inside;
                for (int k = 0; k < MODES; k++) q[k] = q0[k], v[k] = v0[k];
                y = y0;
                advance(t, middle);
                if (fabs(tip(q) - y) > CLEARANCE) outside = middle; else inside = middle;
            }
            t += inside;
            left -= inside;
            double relative = tip(v) - ball, impulse = (1 + RESTITUTION) * relative / (1 / BALL + MODES / MASS);
            if (relative * (tip(q) - y) > 0) {
                for (int k = 0; k < MODES; k++) v[k] -= impulse / MASS;
                ball += impulse / BALL;
            }
            if (i >= first && fabs(tip(q)) > peak) peak = fabs(tip(q));
        }
        t = (i + 1) * step;
        if (i >= first && fabs(tip(q)) > peak) peak = fabs(tip(q));
    }
    printf("%.3f\n", 1e3 * peak);
    return 0;
}
