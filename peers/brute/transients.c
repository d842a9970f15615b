/* A vibro-impact absorber on an oscillator that is not driven steadily, by small fixed steps of Runge and Kutta's
   fourth-order method. It shares nothing with the program in the folders above, nor with brute.c.

   m1 x'' + c1 x' + k1 x = f(t), m2 y'' = g(t) while |x - y| < b; at a wall the momentum is conserved and the relative
   velocity turns around with factor r; an absorber that comes off a wall slower than `contact` rests on it until the
   force between them pulls. SI units throughout.

   release: x v u (velocity of the absorber) level (amplitude at which the structure has come to rest)
            -> time after which sqrt(x^2 + (x'/w0)^2) stays at the level or below
   sweep:   F kind=force|base from to rate (Hz/s), whole periods of the excitation
   record:  kind=force|base (acceleration of the base) file (time, value; linear in between); x is against the base
   All: m1 k1 c1 m2 r b steps (an oscillation of the structure, or of the excitation if that is faster) places
   Prints for each even place of the absorber: place/b, time, peak of |x|, largest relative speed of an impact, impacts. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static double m1, k1, c1, m2, r, b, F, from, to, rate, level, contact, w0;
static int base, scene; /* 0 release, 1 sweep, 2 record */
static double *rt, *rv;
static long rn;

typedef struct { double x, v, y, u; int rests; } State;

static double phase(double t) { double k = to > from ? rate : -rate; return 2 * PI * (from * t + 0.5 * k * t * t); }

/* force on the structure and acceleration of a free absorber */
static void drive(double t, double *f, double *g) {
    *f = *g = 0;
    if (scene == 1) {
        double k = to > from ? rate : -rate, p = phase(t), w = 2 * PI * (from + k * t);
        *f = base ? k1 * F * sin(p) + c1 * F * w * cos(p) : F * sin(p);
    } else if (scene == 2) {
        static long at = 0;
        if (t < rt[at]) at = 0;
        while (at < rn - 2 && t > rt[at + 1]) at++;
        double a = rv[at] + (rv[at + 1] - rv[at]) * (t - rt[at]) / (rt[at + 1] - rt[at]);
        if (base) { *f = -m1 * a; *g = -a; } else *f = a;
    }
}

static void slope(double t, const State *z, double d[4]) {
    double f, g;
    drive(t, &f, &g);
    d[0] = z->v;
    d[2] = z->u;
    if (z->rests) d[1] = d[3] = (f + m2 * g - c1 * z->v - k1 * z->x) / (m1 + m2);
    else { d[1] = (f - c1 * z->v - k1 * z->x) / m1; d[3] = g; }
}

static State moved(const State *z, const double d[4], double h) {
    State n = {z->x + h * d[0], z->v + h * d[1], z->y + h * d[2], z->u + h * d[3], z->rests};
    return n;
}

static State step(double t, const State *z, double h) {
    double a[4], q[4], c[4], d[4], s[4];
    State n;
    slope(t, z, a);
    n = moved(z, a, h / 2); slope(t + h / 2, &n, q);
    n = moved(z, q, h / 2); slope(t + h / 2, &n, c);
    n = moved(z, c, h); slope(t + h, &n, d);
    for (int i = 0; i < 4; i++) s[i] = (a[i] + 2 * q[i] + 2 * c[i] + d[i]) / 6;
    return moved(z, s, h);
}

static double amplitude(const State *z) { return hypot(z->x, z->v / w0); }

static double fly(double place, double x0, double v0, double u0, double h, double end, double *peak, double *speed, long *hits) {
    State z = {x0, v0, x0 - place * b, u0, 0};
    double t = 0, settled = amplitude(&z) > level ? INFINITY : 0, last_t = 0, last_a = amplitude(&z);
    *peak = fabs(x0); *speed = 0; *hits = 0;
    while (t < end) {
        double left = fmin(h, end - t);
        int parts = 0;
        while (left > 0 && parts++ < 1000) {
            State n = step(t, &z, left);
            double part = left;
            int hit = 0;
            if (!z.rests) {
                double w = n.x - n.y;
                if (fabs(w) > b && (n.v - n.u) * w > 0) {
                    double low = 0, high = left;
                    for (int i = 0; i < 60; i++) {
                        double mid = 0.5 * (low + high);
                        State m = step(t, &z, mid);
                        if (fabs(m.x - m.y) > b) high = mid; else low = mid;
                    }
                    part = high;
                    n = step(t, &z, part);
                    hit = n.x > n.y ? 1 : -1;
                }
            } else {
                double d[4], f, g;
                slope(t + left, &n, d);
                drive(t + left, &f, &g);
                /* the wall pushes the absorber towards the structure's side */
                if (z.rests * (d[3] - g) < 0) n.rests = 0;
            }
            /* a turning point of x inside the part: the cubic through its ends */
            if (z.v * n.v < 0) {
                double dd = part * (z.v + n.v) - 2 * (n.x - z.x), cc = 3 * (n.x - z.x) - part * (2 * z.v + n.v);
                double root = sqrt(fmax(0, cc * cc - 3 * dd * part * z.v)), p = -part * z.v / (cc + copysign(root, -z.v));
                if (p > 0 && p < 1) *peak = fmax(*peak, fabs(z.x + p * (part * z.v + p * (cc + p * dd))));
            }
            *peak = fmax(*peak, fmax(fabs(z.x), fabs(n.x)));
            t += part; left -= part;
            double seen[2] = {amplitude(&n), 0};
            int count = 1;
            if (hit) {
                double rel = n.v - n.u, total = m1 + m2;
                *speed = fmax(*speed, fabs(rel)); ++*hits;
                double mean = (m1 * n.v + m2 * n.u) / total;
                n.v = mean - r * rel * m2 / total;
                n.u = mean + r * rel * m1 / total;
                n.y = n.x - hit * b;
                if (fabs(r * rel) < contact) { n.v = n.u = mean; n.rests = hit; }
                seen[count++] = amplitude(&n);
            }
            for (int i = 0; i < count; i++) {
                if (seen[i] > level) settled = INFINITY;
                else if (isinf(settled)) {
                    double share = log(last_a / level) / log(last_a / seen[i]);
                    settled = last_t + (t - last_t) * (isfinite(share) ? share : 1);
                }
                last_t = t; last_a = seen[i];
            }
            z = n;
        }
        if (scene == 0 && last_a < 0.8 * level && t > settled + 3 * 2 * PI / w0) break;
    }
    return settled;
}

static double key(int n, char **words, const char *name, double otherwise) {
    size_t length = strlen(name);
    for (int i = 2; i < n; i++)
        if (!strncmp(words[i], name, length) && words[i][length] == '=') return atof(words[i] + length + 1);
    return otherwise;
}

int main(int n, char **words) {
    const char *file = NULL;
    for (int i = 2; i < n; i++) {
        if (!strcmp(words[i], "kind=base")) base = 1;
        if (!strncmp(words[i], "file=", 5)) file = words[i] + 5;
    }
    scene = !strcmp(words[1], "release") ? 0 : !strcmp(words[1], "sweep") ? 1 : 2;
    m1 = key(n, words, "m1", 1); k1 = key(n, words, "k1", 1); c1 = key(n, words, "c1", 0); m2 = key(n, words, "m2", 0.01);
    r = key(n, words, "r", 0.6); b = key(n, words, "b", 1); F = key(n, words, "F", 0); level = key(n, words, "level", 0);
    from = key(n, words, "from", 1); to = key(n, words, "to", 1); rate = key(n, words, "rate", 1);
    w0 = sqrt(k1 / m1);
    contact = key(n, words, "contact", 1e-8 * b * w0);
    double steps = key(n, words, "steps", 400), end = key(n, words, "end", 1), h = 2 * PI / w0 / steps;
    if (scene == 1) {
        double k = to > from ? rate : -rate, whole = floor((to * to - from * from) / (2 * k) * (1 + 1e-12));
        end = 2 * whole / (from + sqrt(from * from + 2 * k * whole));
        h = fmin(h, 1 / fmax(from, to) / steps);
    }
    if (scene == 2) {
        FILE *in = fopen(file, "r");
        char line[256];
        rt = malloc(sizeof(double) * 10000000); rv = malloc(sizeof(double) * 10000000);
        while (in && fgets(line, sizeof line, in)) if (sscanf(line, "%lf,%lf", &rt[rn], &rv[rn]) == 2) rn++;
        double begin = rt[0];
        for (long i = 0; i < rn; i++) rt[i] -= begin;
        end = rt[rn - 1];
    }
    long places = (long)key(n, words, "places", 32);
    puts("place,time,peak,speed,impacts");
    for (long i = 0; i < places; i++) {
        double w = (2 * i + 1.0) / places - 1, peak, speed;
        long hits;
        double t = fly(w, key(n, words, "x", 0), key(n, words, "v", 0), key(n, words, "u", 0), h, end, &peak, &speed, &hits);
        printf("%.12g,%.12g,%.12g,%.12g,%ld\n", w, t, peak, speed, hits);
    }
    return 0;
}
