/* A vibro-impact absorber on an oscillator, by small fixed steps. It shares nothing with the program in the
   folders above and answers one question: how large are the long-term motions of one design?

   m1 x'' + c1 x' + k1 x = force(t), m2 y'' = 0 while |x - y| < b; at a wall (x - y = side b) the momentum is
   conserved and the relative velocity turns around with factor r. A force: force(t) = F sin(omega t). A base that
   moves by F sin(omega t): force(t) = k1 F sin(omega t) + c1 omega F cos(omega t). While the mass rests on a wall
   both move as one mass m1 + m2 until the contact force changes sign. SI units throughout.

   Method: (x, x') less its steady part goes from step to step by one 2 x 2 matrix, the absorber by a straight line.
   A step at whose end |w| > b, or in which w has a maximum that may reach b, is done again by parts: the first
   crossing by Newton's method between brackets, impact, and so on to the end of the step.

   usage: brute run  key=value...      one motion: peak, impacts, energy balance
          brute scan key=value...      every clearance x frequency: the largest peaks from several starts
          brute bare key=value...      every frequency: bare amplitude, largest displacement of the transient from rest
          brute ends key=value...      every start: peak and impacts of a window after so many periods
   keys:  m1 k1 c1 m2 r kind=force|base F ; steps (per period), efolds, minperiods, window, windows, contact
   run:   f b x v y u            scan: from to n starts seed carry stop b=B1,B2,...            bare: from to n
   ends:  f b starts seed after=N1,N2,...   */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define MAX_STEPS 4096
#define MAX_WINDOWS 16

typedef struct { /* one moving mass, m1 or m1 + m2 */
    double m, w0sq, decay, wd;          /* k1/m, c1/(2 m), damped angular frequency */
    double fs, fc, S, C;                /* force/m and steady part: S sin + C cos of the phase */
    double p[4];                        /* free motion over one step */
    double xs[MAX_STEPS + 1], vs[MAX_STEPS + 1];
} Mode;

typedef struct {
    double m1, k1, c1, m2, r, F, b, omega, h, contact;
    int base, steps;
    Mode mode[2];                       /* 0: the absorber is free, 1: it rests on a wall */
} Problem;

typedef struct {
    double x, v, y, u;                  /* at the start of a step or inside it */
    int rests;                          /* side of the wall that the absorber rests on, or 0 */
} State;

typedef struct {
    double peak;                        /* largest |x| since it was set to 0 */
    long impacts, rests;
    int energy;                         /* whether to sum the energies below, in J */
    double in, damper, loss;
} Tally;

static void mode_set(Problem *p, Mode *q, double m) {
    double c = p->c1, k = p->k1, w = p->omega, h = p->h;
    q->m = m;
    q->w0sq = k / m;
    q->decay = c / (2 * m);
    q->wd = sqrt(q->w0sq - q->decay * q->decay);
    q->fs = (p->base ? k * p->F : p->F) / m;
    q->fc = (p->base ? c * w * p->F : 0) / m;
    double stiff = q->w0sq - w * w, damp = 2 * q->decay * w, det = stiff * stiff + damp * damp;
    q->S = (stiff * q->fs + damp * q->fc) / det;
    q->C = (stiff * q->fc - damp * q->fs) / det;
    double e = exp(-q->decay * h), co = cos(q->wd * h), si = sin(q->wd * h) / q->wd;
    q->p[0] = e * (co + q->decay * si);
    q->p[1] = e * si;
    q->p[2] = -e * q->w0sq * si;
    q->p[3] = e * (co - q->decay * si);
    for (int i = 0; i <= p->steps; i++) {
        double a = 2 * PI * (i % p->steps) / p->steps;
        q->xs[i] = q->S * sin(a) + q->C * cos(a);
        q->vs[i] = w * (q->S * cos(a) - q->C * sin(a));
    }
}

static void problem_set(Problem *p, double frequency, double b) {
    p->omega = 2 * PI * frequency;
    p->b = b;
    p->h = 1 / (frequency * p->steps);
    mode_set(p, &p->mode[0], p->m1);
    mode_set(p, &p->mode[1], p->m1 + p->m2);
}

static double bare_amplitude(const Problem *p) { return hypot(p->mode[0].S, p->mode[0].C); }

/* One flight (or rest) inside a step: its state as a function of the time s since it began. */
typedef struct {
    const Problem *p;
    const Mode *q;
    double phase, xf, vf, y, u;
} Flight;

static Flight flight_from(const Problem *p, const State *z, double phase) {
    const Mode *q = &p->mode[z->rests != 0];
    double si = sin(phase), co = cos(phase);
    Flight f = {p, q, phase, z->x - (q->S * si + q->C * co), z->v - p->omega * (q->S * co - q->C * si), z->y, z->u};
    return f;
}

static void flight_at(const Flight *f, double s, double *x, double *v) {
    const Mode *q = f->q;
    double e = exp(-q->decay * s), a = q->wd * s, co = cos(a), si = sin(a) / q->wd;
    double ph = f->phase + f->p->omega * s, ps = sin(ph), pc = cos(ph);
    *x = e * (f->xf * co + (f->vf + q->decay * f->xf) * si) + q->S * ps + q->C * pc;
    *v = e * (f->vf * co - (q->decay * f->vf + q->w0sq * f->xf) * si) + f->p->omega * (q->S * pc - q->C * ps);
}

static double acceleration(const Mode *q, double phase, double x, double v) {
    return q->fs * sin(phase) + q->fc * cos(phase) - 2 * q->decay * v - q->w0sq * x;
}

/* side w - b and its rate; or x' and x''; or the contact force on the absorber over m2, towards the wall. */
enum { GAP, SPEED, GAP_RATE, FORCE };
static double value(const Flight *f, int what, int side, double s, double *rate) {
    double x, v;
    flight_at(f, s, &x, &v);
    double ph = f->phase + f->p->omega * s, a = acceleration(f->q, ph, x, v);
    switch (what) {
    case GAP: *rate = side * (v - f->u); return side * (x - f->y - f->u * s) - f->p->b;
    case SPEED: *rate = a; return v;
    case GAP_RATE: *rate = side * a; return side * (v - f->u);
    default:
        *rate = side * (f->p->omega * (f->q->fs * cos(ph) - f->q->fc * sin(ph)) - 2 * f->q->decay * a - f->q->w0sq * v);
        return side * a;
    }
}

/* A zero between lo and hi, where the values differ in sign: Newton's method, bisection where it leaves the bracket. */
static double zero(const Flight *f, int what, int side, double lo, double hi) {
    double rate, low = value(f, what, side, lo, &rate), s = lo - low / rate, tiny = 1e-11 * f->p->h; /* Newton: the next is far below */
    if (!(s > lo && s < hi)) s = 0.5 * (lo + hi);
    for (int i = 0; i < 100; i++) {
        double g = value(f, what, side, s, &rate);
        if ((g < 0) == (low < 0)) lo = s; else hi = s;
        double next = s - g / rate;
        if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
        if (fabs(next - s) < tiny || hi - lo < tiny) return next;
        s = next;
    }
    return s;
}

/* The first time in (0, end] at which the absorber reaches the wall at `side`, or -1; side w - b and its rate at both
   ends are given. */
static double crossing(const Flight *f, int side, double end, double g0, double rate0, double g1, double rate1) {
    double lo = 0, hi = end, rate;
    if (g0 >= 0 && rate0 > 0) return 0;
    if (g1 < 0) { /* not beyond at the end: a maximum between? */
        if (!(rate0 > 0 && rate1 < 0)) return -1;
        hi = zero(f, GAP_RATE, side, 0, end);
        if (value(f, GAP, side, hi, &rate) < 0) return -1;
    } else if (g0 >= 0) { /* it has just left this wall: the way back starts where w' changes sign */
        if (rate1 <= 0 || rate0 == 0) { /* down, up and over within one step: look closer */
            int i = 1;
            while (i <= 64 && !(value(f, GAP, side, end * i / 64, &rate1) > 0)) i++;
            if (i > 64) return -1;
            hi = end * i / 64;
            lo = end * (i - 1) / 64;
            if (i > 1) return zero(f, GAP, side, lo, hi);
            if (rate1 <= 0 || rate0 == 0) return -1; /* within a 64th of a step of the release */
        }
        lo = zero(f, GAP_RATE, side, 0, hi);
        if (value(f, GAP, side, lo, &rate) >= 0) return lo; /* closer than rounding can tell */
    }
    return zero(f, GAP, side, lo, hi);
}

static void tally(Tally *t, const Flight *f, double x0, double v0, double s, double x1, double v1) {
    double larger = fmax(fabs(x0), fabs(x1));
    if (larger > t->peak) t->peak = larger;
    if (v0 * v1 < 0 && larger > 0.9 * t->peak) {
        double x, v;
        flight_at(f, zero(f, SPEED, 1, 0, s), &x, &v);
        if (fabs(x) > t->peak) t->peak = fabs(x);
    }
    if (t->energy) { /* Gauss's rule with four points */
        static const double at[2] = {0.3399810435848563, 0.8611363115940526}, weight[2] = {0.6521451548625461, 0.3478548451374538};
        for (int i = 0; i < 4; i++) {
            double q = 0.5 * s * (1 + (i & 1 ? 1 : -1) * at[i / 2]), x, v, ph = f->phase + f->p->omega * q, w = 0.5 * s * weight[i / 2];
            flight_at(f, q, &x, &v);
            t->in += w * v * f->q->m * (f->q->fs * sin(ph) + f->q->fc * cos(ph));
            t->damper += w * v * v * f->p->c1;
        }
    }
}

static void impact(const Problem *p, State *z, int side, double phase, Tally *t) {
    double eps = p->m2 / p->m1, w = z->v - z->u, r = p->r;
    double a = side * acceleration(&p->mode[0], phase, z->x, z->v);
    z->y = z->x - side * p->b;
    if (r * fabs(w) < p->contact * p->omega * p->b && a > 0) {
        r = 0;
        z->rests = side;
        t->rests++;
    }
    t->impacts++;
    t->loss += 0.5 * p->m2 / (1 + eps) * (1 - r * r) * w * w;
    z->v -= (1 + r) * eps / (1 + eps) * w;
    z->u += (1 + r) / (1 + eps) * w;
    if (z->rests) z->u = z->v;
}

/* Step k by parts, from crossing to crossing. */
static void step_by_parts(const Problem *p, State *z, int k, Tally *t) {
    double s = 0, h = p->h;
    while (s < h) {
        double phase = 2 * PI * k / p->steps + p->omega * s, end = h - s, x, v, rate;
        Flight f = flight_from(p, z, phase);
        int side = 0;
        if (z->rests) {
            if (value(&f, FORCE, z->rests, end, &rate) < 0) {
                double go = value(&f, FORCE, z->rests, 0, &rate) > 0 ? zero(&f, FORCE, z->rests, 0, end) : 0;
                end = fmin(go + 1e-9 * h, end);
                side = 2;
            }
        } else {
            flight_at(&f, end, &x, &v);
            double w0 = z->x - z->y, d0 = z->v - z->u, w1 = x - z->y - z->u * end, d1 = v - z->u, b = p->b;
            double plus = crossing(&f, 1, end, w0 - b, d0, w1 - b, d1), minus = crossing(&f, -1, end, -w0 - b, -d0, -w1 - b, -d1);
            if (plus >= 0 && (minus < 0 || plus <= minus)) { side = 1; end = plus; }
            else if (minus >= 0) { side = -1; end = minus; }
        }
        if (z->rests || side) flight_at(&f, end, &x, &v);
        tally(t, &f, z->x, z->v, end, x, v);
        z->x = x;
        z->v = v;
        if (z->rests) {
            z->y = x - z->rests * p->b;
            z->u = v;
            if (side == 2) z->rests = 0;
        } else {
            z->y += z->u * end;
            if (side) impact(p, z, side, phase + p->omega * end, t);
        }
        s += end;
        if (!side) break;
    }
}

static void one_period(const Problem *p, State *z, Tally *t) {
    for (int k = 0; k < p->steps; k++) {
        const Mode *q = &p->mode[z->rests != 0];
        double xf = z->x - q->xs[k], vf = z->v - q->vs[k], h = p->h;
        double x = q->p[0] * xf + q->p[1] * vf + q->xs[k + 1], v = q->p[2] * xf + q->p[3] * vf + q->vs[k + 1];
        double y = z->y + z->u * h, w = x - y, rate = v - z->u;
        int suspect;
        if (z->rests) {
            suspect = z->rests * acceleration(q, 2 * PI * (k + 1) / p->steps, x, v) <= 0;
            y = x - z->rests * p->b;
        } else {
            double w0 = z->x - z->y, rate0 = z->v - z->u, near = fmax(fabs(w0), fabs(w));
            suspect = fabs(w) >= p->b || fabs(w0) >= p->b || (rate0 * rate < 0 && near + h * fmin(fabs(rate0), fabs(rate)) > p->b);
        }
        double larger = fmax(fabs(x), fabs(z->x));
        if (suspect) {
            step_by_parts(p, z, k, t);
            continue;
        }
        if (t->energy || (z->v * v < 0 && larger > 0.9 * t->peak)) {
            Flight f = flight_from(p, z, 2 * PI * k / p->steps);
            tally(t, &f, z->x, z->v, h, x, v);
        } else if (larger > t->peak) {
            t->peak = larger;
        }
        z->x = x;
        z->v = v;
        z->y = y;
        z->u = z->rests ? v : z->u;
    }
}

/* ---- starts ---- */

static double scattered(unsigned long *seed) { /* xorshift; uniform in (0, 1) */
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    return (double)(*seed >> 11) * (1.0 / 9007199254740992.0);
}

/* Start number i, always at phase 0. 0, 3, 4, 5: the structure at rest, the absorber at rest at 0, 0.5, -0.5, 0.9 b;
   1: the structure in its bare steady motion, the absorber moving with a wall; the others: the structure in a motion of
   up to 1.5 times the bare amplitude (2: exactly that), the absorber anywhere with up to omega (A + b). */
static State start(const Problem *p, int i, unsigned long seed) {
    static const double rest[6] = {0, 0, 0, 0.5, -0.5, 0.9};
    const Mode *q = &p->mode[0];
    State z = {0, 0, 0, 0, 0};
    if (i == 0 || (i >= 3 && i < 6)) {
        z.y = rest[i] * p->b;
        return z;
    }
    if (i == 1) {
        z.x = q->C;
        z.v = p->omega * q->S;
        z.y = z.x - p->b;
        z.u = z.v;
        return z;
    }
    seed = seed * 2654435761UL + 88172645463325252UL + 1000003UL * (unsigned long)i;
    for (int j = 0; j < 8; j++) scattered(&seed);
    double A = bare_amplitude(p), size = i == 2 ? 1.5 * A : 1.5 * A * scattered(&seed), a = 2 * PI * scattered(&seed);
    z.x = size * cos(a);
    z.v = size * p->omega * sin(a);
    z.y = z.x - p->b * (1.98 * scattered(&seed) - 0.99);
    z.u = p->omega * (A + p->b) * (2 * scattered(&seed) - 1);
    return z;
}

typedef struct { double efolds; int minimum, window, windows; } Plan;

static int periods_left_out(const Problem *p, const Plan *plan) {
    double n = ceil(plan->efolds / p->mode[0].decay * p->omega / (2 * PI));
    return n > plan->minimum ? (int)n : plan->minimum;
}

/* Largest |x| of the bare structure that starts from rest. */
static double bare_transient(const Problem *p, const Plan *plan) {
    Problem far = *p;
    far.b = INFINITY;
    State z = {0, 0, 0, 0, 0};
    Tally t = {0};
    int n = periods_left_out(p, plan);
    for (int i = 0; i < n; i++) one_period(&far, &z, &t);
    return fmax(t.peak, bare_amplitude(p));
}

/* Leaves the transient out; peaks of each window, impacts in all of them. */
static long follow(const Problem *p, const Plan *plan, State *z, double *peaks) {
    Tally t = {0};
    int n = periods_left_out(p, plan);
    t.peak = INFINITY;
    for (int i = 0; i < n; i++) one_period(p, z, &t);
    t.impacts = 0;
    for (int j = 0; j < plan->windows; j++) {
        t.peak = 0;
        for (int i = 0; i < plan->window; i++) one_period(p, z, &t);
        peaks[j] = t.peak;
    }
    return t.impacts;
}

/* ---- command line ---- */

static const char *text(int n, char **a, const char *key, const char *otherwise) {
    size_t len = strlen(key);
    for (int i = 2; i < n; i++)
        if (!strncmp(a[i], key, len) && a[i][len] == '=') return a[i] + len + 1;
    if (!otherwise) {
        fprintf(stderr, "brute: %s= is missing\n", key);
        exit(2);
    }
    return otherwise;
}
static double number(int n, char **a, const char *key, const char *otherwise) { return atof(text(n, a, key, otherwise)); }

static void run(int n, char **a, Problem *p, Plan *plan) {
    problem_set(p, number(n, a, "f", NULL), number(n, a, "b", NULL));
    State z = {number(n, a, "x", "0"), number(n, a, "v", "0"), number(n, a, "y", "0"), number(n, a, "u", "0"), 0};
    double w = plan->windows * plan->window;
    int out = periods_left_out(p, plan);
    Tally t = {0};
    t.energy = 1;
    double e0 = 0.5 * (p->m1 * z.v * z.v + p->k1 * z.x * z.x + p->m2 * z.u * z.u);
    for (int i = 0; i < out; i++) one_period(p, &z, &t);
    t.peak = 0;
    long impacts = t.impacts, rests = t.rests;
    for (int i = 0; i < w; i++) one_period(p, &z, &t);
    double e1 = 0.5 * (p->m1 * z.v * z.v + p->k1 * z.x * z.x + p->m2 * z.u * z.u);
    printf("bare %.9g\npeak %.9g\nimpacts_per_period %.6g\nrests_per_period %.6g\n", bare_amplitude(p), t.peak, (t.impacts - impacts) / w, (t.rests - rests) / w);
    printf("work_in %.9g\ndamper %.9g\nimpact_loss %.9g\nstored %.9g\nresidual %.3g\n", t.in, t.damper, t.loss, e1 - e0,
           fabs(t.in - t.damper - t.loss - e1 + e0) / fabs(t.in));
    printf("end %.15g %.15g %.15g %.15g\nbare_transient %.9g\n", z.x, z.v, z.y, z.u, bare_transient(p, plan));
}

/* What each start is like after so many periods, in a window that begins there: a row for each. `after` ascends. */
static void ends(int n, char **a, Problem *p, Plan *plan) {
    problem_set(p, number(n, a, "f", NULL), number(n, a, "b", NULL));
    int starts = (int)number(n, a, "starts", "24");
    unsigned long seed = (unsigned long)number(n, a, "seed", "1");
    printf("start,after,peak,impacts_per_period\n");
    for (int i = 0; i < starts; i++) {
        State z = start(p, i, seed);
        long flown = 0;
        for (const char *after = text(n, a, "after", NULL); after; after = strchr(after, ',') ? strchr(after, ',') + 1 : NULL) {
            Tally t = {0};
            t.peak = INFINITY;
            for (; flown < atol(after); flown++) one_period(p, &z, &t);
            t.peak = 0;
            t.impacts = 0;
            for (int k = 0; k < plan->window; k++, flown++) one_period(p, &z, &t);
            printf("%d,%ld,%.9g,%.6g\n", i, atol(after), t.peak, (double)t.impacts / plan->window);
        }
    }
}

/* One row per frequency, of motions with impacts: the largest peak, the mean over the windows of that motion's peaks,
   and the smallest peak of a window. */
typedef struct { double f, bare, worst, typical, least, rate; int start, moving; } Row;

static void add(Row *row, const Plan *plan, const double *peaks, long impacts, int start_number) {
    double sum = 0, most = 0;
    if (!impacts) return;
    row->moving++;
    for (int j = 0; j < plan->windows; j++) {
        sum += peaks[j];
        most = fmax(most, peaks[j]);
        row->least = fmin(row->least, peaks[j]);
    }
    if (most <= row->worst) return;
    row->worst = most;
    row->typical = sum / plan->windows;
    row->start = start_number;
    row->rate = (double)impacts / (plan->window * plan->windows);
}

static int larger_bare(const void *a, const void *b) {
    double x = ((const Row *)a)->bare, y = ((const Row *)b)->bare;
    return (x < y) - (x > y);
}

/* All starts at every frequency, and, with carry=1, the end of the largest motion at the neighbour, upwards and then
   downwards. With carry=0 the frequencies come in order of the bare amplitude, until a peak exceeds `stop`. */
static void scan(int n, char **a, Problem *p, Plan *plan) {
    double from = number(n, a, "from", NULL), to = number(n, a, "to", NULL), stop = number(n, a, "stop", "inf");
    int count = (int)number(n, a, "n", "400"), starts = (int)number(n, a, "starts", "8"), carry = (int)number(n, a, "carry", "1");
    unsigned long seed = (unsigned long)number(n, a, "seed", "1");
    Row *rows = malloc(sizeof(Row) * (size_t)count);
    State *end = malloc(sizeof(State) * (size_t)count);
    char *list = strdup(text(n, a, "b", NULL));
    printf("b,f,bare,worst,typical,least,impacts_per_period,start,moving\n");
    for (char *b = strtok(list, ","); b; b = strtok(NULL, ",")) {
        double peaks[MAX_WINDOWS], worst = 0;
        for (int i = 0; i < count; i++) {
            Row empty = {count > 1 ? from + (to - from) * i / (count - 1) : from, 0, 0, 0, INFINITY, 0, -1, 0};
            problem_set(p, empty.f, atof(b));
            empty.bare = bare_amplitude(p);
            rows[i] = empty;
        }
        if (!carry) qsort(rows, (size_t)count, sizeof(Row), larger_bare);
        for (int down = 0; down < (carry ? 2 : 1); down++) {
            for (int j = 0; j < count && worst <= stop; j++) {
                int i = down ? count - 1 - j : j, neighbour = down ? i + 1 : i - 1;
                Row *row = &rows[i];
                problem_set(p, row->f, atof(b));
                double best = row->worst;
                for (int k = -(j && carry && rows[neighbour].moving); k < (down ? 0 : starts); k++) {
                    State z = k < 0 ? end[neighbour] : start(p, k, seed * 7919UL + (unsigned long)i);
                    long impacts = follow(p, plan, &z, peaks);
                    add(row, plan, peaks, impacts, k < 0 ? -1 - down : k);
                    if (row->worst > best) {
                        best = row->worst;
                        end[i] = z;
                    }
                }
                worst = fmax(worst, best);
            }
        }
        for (int i = 0; i < count; i++) {
            Row *o = &rows[i];
            if (o->moving)
                printf("%s,%.9g,%.7g,%.7g,%.7g,%.7g,%.4g,%d,%d\n", b, o->f, o->bare, o->worst, o->typical, o->least, o->rate, o->start, o->moving);
        }
        fflush(stdout);
    }
    free(rows);
    free(end);
    free(list);
}

/* Steady amplitude of the bare structure and the largest displacement of its transient from rest. */
static void bare(int n, char **a, Problem *p, Plan *plan) {
    double from = number(n, a, "from", NULL), to = number(n, a, "to", NULL);
    int count = (int)number(n, a, "n", "2000");
    printf("f,amplitude,transient\n");
    for (int i = 0; i < count; i++) {
        double f = from + (to - from) * i / (count - 1);
        problem_set(p, f, INFINITY);
        printf("%.9g,%.9g,%.9g\n", f, bare_amplitude(p), bare_transient(p, plan));
    }
}

int main(int n, char **a) {
    static Problem p;
    void (*verb)(int, char **, Problem *, Plan *) = NULL;
    if (n > 1) verb = !strcmp(a[1], "run") ? run : !strcmp(a[1], "scan") ? scan : !strcmp(a[1], "bare") ? bare : !strcmp(a[1], "ends") ? ends : NULL;
    if (!verb) {
        fprintf(stderr, "usage: brute run|scan|bare|ends key=value...\n");
        return 2;
    }
    p.m1 = number(n, a, "m1", NULL);
    p.k1 = number(n, a, "k1", NULL);
    p.c1 = number(n, a, "c1", NULL);
    p.m2 = number(n, a, "m2", NULL);
    p.r = number(n, a, "r", NULL);
    p.F = number(n, a, "F", NULL);
    p.base = !strcmp(text(n, a, "kind", NULL), "base");
    p.steps = (int)number(n, a, "steps", "32");
    p.contact = number(n, a, "contact", "1e-4");
    Plan plan = {number(n, a, "efolds", "8"), (int)number(n, a, "minperiods", "200"), (int)number(n, a, "window", "200"),
                 (int)number(n, a, "windows", "2")};
    if (p.steps < 8 || p.steps > MAX_STEPS || plan.windows < 1 || plan.windows > MAX_WINDOWS) {
        fprintf(stderr, "brute: 8 to %d steps, 1 to %d windows\n", MAX_STEPS, MAX_WINDOWS);
        return 2;
    }
    verb(n, a, &p, &plan);
    return 0;
}
