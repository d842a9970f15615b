/* A structure of several modes with several absorbers in closed form between contacts, 400 steps in a period of the fastest of
   modes and excitation, and bisection of each contact; an absorber that rests on a wall is held there by a plastic impact at the end
   of each eighth of a step: shares no code and no method with the engine, which proves its impacts.
   Reads, in SI units: modes N, absorbers M; of each mode its frequency in Hz, damping ratio, mass, force, participation and its shape
   at the place that is watched and at each absorber; of each absorber mass, clearance and restitution; the excitation's frequency in
   Hz, the amplitude of the base, a seed, periods that are left out and periods that are measured; and, if there is one more number,
   which absorbers rest, 1 for the first, 2 for the second, 4 for the third: the structure moves without them through half of the
   periods that are left out, then each is put somewhere in its cavity without a velocity. Prints the largest displacement of
   the place in m, its root mean square, the same of its velocity and of its acceleration between contacts, the largest jump of its
   velocity, impacts of each absorber in a period, and the phase of the last impact of each, over the period, with its speed then.
   cc -O2 simulate.c -lm */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 8, STEPS = 400, FINER = 8, CONTACTS = 12, HALVINGS = 36 };
static int modes, absorbers;
static double w[MOST], damping[MOST], mass[MOST], force[MOST], watched[MOST], shape[MOST][MOST], base;
static double participation[MOST], ball[MOST], clearance[MOST], restitution[MOST], omega;
static double q[MOST], v[MOST], y[MOST], u[MOST];
static int absent[MOST];
/* The wall that an absorber rests on, 1 or -1; 0 where it does not. */
static int held[MOST];
static double steady[MOST][2];
/* What a whole step makes of a free motion. */
static double whole[MOST][4];

/* What the modes and the base, displaced by `moved`, come to at the place that is watched, and at an absorber. */
static double sum(const double *of, double moved)
{
    for (int k = 0; k < modes; k++) moved += watched[k] * of[k];
    return moved;
}

static double at(int j, const double *of, double moved)
{
    for (int k = 0; k < modes; k++) moved += shape[k][j] * of[k];
    return moved;
}

static void free_motion(int k, double h, double *of)
{
    double wd = w[k] * sqrt(1 - damping[k] * damping[k]), e = exp(-damping[k] * w[k] * h);
    double cosine = e * cos(wd * h), sine = e * sin(wd * h) / wd, own = damping[k] * w[k];
    of[0] = cosine + own * sine;
    of[1] = sine;
    of[2] = -w[k] * w[k] * sine;
    of[3] = cosine - own * sine;
}

static void advance(double t, double h, int is_whole)
{
    double s0 = sin(omega * t), c0 = cos(omega * t), s1 = sin(omega * (t + h)), c1 = cos(omega * (t + h)), some[4];
    for (int k = 0; k < modes; k++) {
        const double *by = whole[k], *of = steady[k];
        if (!is_whole) {
            free_motion(k, h, some);
            by = some;
        }
        double x = q[k] - (of[0] * s0 + of[1] * c0), r = v[k] - omega * (of[0] * c0 - of[1] * s0);
        q[k] = of[0] * s1 + of[1] * c1 + by[0] * x + by[1] * r;
        v[k] = omega * (of[0] * c1 - of[1] * s1) + by[2] * x + by[3] * r;
    }
    for (int j = 0; j < absorbers; j++) y[j] += u[j] * h;
}

/* The absorber that is farthest beyond its walls; none where all are within. */
static int beyond(double t)
{
    int worst = -1;
    double most = 1, moved = base * sin(omega * t);
    for (int j = 0; j < absorbers; j++) {
        double gap = fabs(at(j, q, moved) - y[j]) / clearance[j];
        if (!absent[j] && !held[j] && gap > most) worst = j, most = gap;
    }
    return worst;
}

/* The acceleration of a mode, and of the place that is watched, without the force of what is held. */
static double of_mode(int k, double s)
{
    return force[k] / mass[k] * s - 2 * damping[k] * w[k] * v[k] - w[k] * w[k] * q[k];
}

static double acceleration(double t)
{
    double s = sin(omega * t), all = -base * omega * omega * s;
    for (int k = 0; k < modes; k++) all += watched[k] * of_mode(k, s);
    return all;
}

/* An impact of an absorber with a restitution, and the jump of the velocity at the place that is watched. */
static double strike(int j, double t, double r)
{
    double relative = at(j, v, base * omega * cos(omega * t)) - u[j], yields = 1 / ball[j], jump = 0;
    for (int k = 0; k < modes; k++) yields += shape[k][j] * shape[k][j] / mass[k];
    double impulse = (1 + r) * relative / yields;
    for (int k = 0; k < modes; k++) {
        v[k] -= impulse * shape[k][j] / mass[k];
        jump += watched[k] * impulse * shape[k][j] / mass[k];
    }
    u[j] += impulse / ball[j];
    return jump;
}

/* Whether an absorber at a wall bounces no more: its next flight, after an impact that it leaves with such a speed, is a small part
   of a step. */
static int stays(int j, double t, double step, double speed, int side)
{
    double s = sin(omega * t), pressed = -base * omega * omega * s;
    for (int k = 0; k < modes; k++) pressed += shape[k][j] * of_mode(k, s);
    return 2 * speed < 0.1 * step * pressed * side;
}

/* What is held goes with its wall, or leaves it. */
static void hold(double t)
{
    for (int sweep = 0; sweep < 3; sweep++)
        for (int j = 0; j < absorbers; j++) {
            if (!held[j]) continue;
            double relative = at(j, v, base * omega * cos(omega * t)) - u[j];
            if (sweep == 0 && relative * held[j] < 0) held[j] = 0;
            else strike(j, t, 0);
        }
    for (int j = 0; j < absorbers; j++)
        if (held[j]) y[j] = at(j, q, base * sin(omega * t)) - held[j] * clearance[j];
}

/* Displacement, velocity and acceleration of the place: the largest, and sums of squares at ends of steps. */
static double peaks[3], squares[3], jumps;

static void measure(double t, int ends)
{
    double now[3] = {sum(q, base * sin(omega * t)), sum(v, base * omega * cos(omega * t)), acceleration(t)};
    int free = 1;
    for (int j = 0; j < absorbers; j++) free = free && !held[j];
    /* With what is held the acceleration is another. */
    for (int n = 0; n < 2 + free; n++) {
        if (fabs(now[n]) > peaks[n]) peaks[n] = fabs(now[n]);
        if (ends) squares[n] += now[n] * now[n];
    }
}

static double number(void)
{
    double value;
    if (scanf("%lf", &value) != 1) exit(2);
    return value;
}

int main(void)
{
    modes = (int)number(), absorbers = (int)number();
    if (modes < 1 || modes > MOST || absorbers < 1 || absorbers > MOST) return 2;
    for (int k = 0; k < modes; k++) {
        w[k] = 2 * M_PI * number();
        damping[k] = number(), mass[k] = number(), force[k] = number(), participation[k] = number(), watched[k] = number();
        for (int j = 0; j < absorbers; j++) shape[k][j] = number();
    }
    for (int j = 0; j < absorbers; j++) ball[j] = number(), clearance[j] = number(), restitution[j] = number();
    omega = 2 * M_PI * number(), base = number();
    /* In coordinates against the base a force that its acceleration makes. */
    for (int k = 0; k < modes; k++) force[k] += mass[k] * participation[k] * omega * omega * base;
    srand((unsigned)number());
    double fastest = omega, out = number(), measured = number(), rest;
    if (scanf("%lf", &rest) != 1) rest = 0;
    for (int j = 0; j < absorbers; j++) absent[j] = ((int)rest >> j) & 1;
    double share = 4.0 * rand() / RAND_MAX, moving = base * omega;
    long impacts[MOST] = {0};
    double last[MOST][2] = {{0}};
    for (int k = 0; k < modes; k++) {
        double a = w[k] * w[k] - omega * omega, b = 2 * damping[k] * w[k] * omega, size = a * a + b * b;
        steady[k][0] = force[k] / mass[k] * a / size;
        steady[k][1] = -force[k] / mass[k] * b / size;
        q[k] = share * steady[k][1];
        v[k] = share * omega * steady[k][0];
        if (w[k] > fastest) fastest = w[k];
    }
    /* A whole number of steps in a period of the excitation: times stay small, and exact. */
    long each = (long)ceil(STEPS * fastest / omega);
    double step = 2 * M_PI / omega / (double)each;
    for (int k = 0; k < modes; k++) free_motion(k, step, whole[k]);
    for (int j = 0; j < absorbers; j++) {
        y[j] = at(j, q, 0) + clearance[j] * 1.9 * ((double)rand() / RAND_MAX - 0.5);
        u[j] = at(j, v, moving);
    }
    long steps = (long)(out + measured) * each, first = (long)out * each;
    for (long i = 0; i < steps; i++) {
        double begin = (double)(i % each) * step;
        for (int j = 0; j < absorbers && i == first / 2; j++) {
            if (!absent[j]) continue;
            double now = at(j, q, base * sin(omega * begin)), place = clearance[j] * (2.0 * rand() / RAND_MAX - 1);
            /* It is inside of its walls now. */
            y[j] = fmax(now - 0.999 * clearance[j], fmin(now + 0.999 * clearance[j], place));
            u[j] = 0, absent[j] = 0;
        }
        int pieces = 1;
        for (int j = 0; j < absorbers; j++) if (held[j]) pieces = FINER;
        for (int piece = 0; piece < pieces; piece++) {
            double from = (double)(i % each) + (double)piece / pieces, t = from * step, left = step / pieces;
            double end = (from + 1.0 / pieces) * step;
            /* So many contacts in a step are of chatter, whose rest is lost. */
            for (int contacts = 0; left > 0; contacts++) {
                double q0[MOST], v0[MOST], y0[MOST];
                for (int k = 0; k < modes; k++) q0[k] = q[k], v0[k] = v[k];
                for (int j = 0; j < absorbers; j++) y0[j] = y[j];
                advance(t, left, contacts == 0 && pieces == 1);
                if (contacts == CONTACTS || beyond(t + left) < 0) break;
                double inside = 0, outside = left;
                int j = beyond(t + left);
                for (int halved = 0; halved <= HALVINGS; halved++) {
                    double middle = halved < HALVINGS ? 0.5 * (inside + outside) : inside;
                    for (int k = 0; k < modes; k++) q[k] = q0[k], v[k] = v0[k];
                    for (int n = 0; n < absorbers; n++) y[n] = y0[n];
                    advance(t, middle, 0);
                    int here = beyond(t + middle);
                    if (here >= 0) j = here, outside = middle;
                    else inside = middle;
                }
                t += inside;
                left -= inside;
                if (i >= first) measure(t, 0);
                double relative = at(j, v, base * omega * cos(omega * t)) - u[j];
                int side = at(j, q, base * sin(omega * t)) > y[j] ? 1 : -1;
                if (relative * side > 0) {
                    double jump = strike(j, t, restitution[j]);
                    if (i >= first && fabs(jump) > jumps) jumps = fabs(jump);
                    last[j][0] = fmod(omega * t / (2 * M_PI), 1), last[j][1] = fabs(u[j]);
                    if (i >= first) impacts[j]++;
                    if (stays(j, t, step, restitution[j] * relative * side, side)) held[j] = side, strike(j, t, 0);
                }
                if (i >= first) measure(t, 0);
            }
            hold(end);
        }
        if (i >= first) measure((double)(i % each + 1) * step, 1);
    }
    for (int n = 0; n < 3; n++) printf("%.9e %.9e ", peaks[n], sqrt(squares[n] / (double)(steps - first)));
    printf("%.9e ", jumps);
    for (int j = 0; j < absorbers; j++) printf("%.6f ", (double)impacts[j] / measured);
    for (int j = 0; j < absorbers; j++) printf("%.15f %.15e ", last[j][0], last[j][1]);
    printf("\n");
    return 0;
}
