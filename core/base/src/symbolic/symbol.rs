//! The one table of symbols: what code, documentation and reports call each quantity.
//!
//! A symbol has the name that formulas give it, so that a formula's parameters are checked against the
//! table when the program is compiled.

/// What is known about a symbol besides its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SymbolEntry {
    /// The name in the code.
    pub name: &'static str,
    /// The name in LaTeX.
    pub latex: &'static str,
    /// What it stands for.
    pub description: &'static str,
    /// Its unit: `1` for a pure number, `length` for whatever unit of length the case uses.
    pub unit: &'static str,
}

macro_rules! symbol_table {
    ($($name:ident: $latex:literal, $unit:literal, $description:literal;)*) => {
        /// A named quantity; its texts are in the table behind [`Symbol::entry`].
        #[allow(non_camel_case_types)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Symbol {
            $(#[doc = $description] $name,)*
        }

        impl Symbol {
            /// Every symbol, in the order of the table.
            pub const ALL: &'static [Symbol] = &[$(Symbol::$name),*];

            /// Name, LaTeX, description and unit.
            pub const fn entry(self) -> SymbolEntry {
                match self {
                    $(Symbol::$name => SymbolEntry {
                        name: stringify!($name), latex: $latex, description: $description, unit: $unit,
                    },)*
                }
            }
        }
    };
}

symbol_table! {
    PI: r"\pi", "1", "ratio of a circle's circumference to its diameter";
    eps: r"\varepsilon", "1", "mass of the absorber over mass of the oscillator";
    lambda: r"\lambda", "1", "damping of the oscillator, so that its term is epsilon lambda x'";
    d: "d", "1", "decay rate of the free oscillator in fast time, epsilon lambda/2";
    r: "r", "1", "coefficient of restitution";
    rho: r"\rho", "1", "short-hand (1 - r)/(1 + r)";
    R: "R", "1", "short-hand 4 rho^2/pi^2";
    sigma: r"\sigma", "1", "detuning, so that Omega = 1 + epsilon sigma";
    Omega: r"\Omega", "1", "excitation frequency over natural frequency";
    T: "T", "1", "period of the excitation in fast time, 2 pi/Omega";
    F: "F", "length", "amplitude of the base displacement";
    G: "G", "length", "reduced forcing, F/epsilon";
    b: "b", "length", "clearance: the absorber is free while |w| < b";
    gamma: r"\gamma", "1", "reduced forcing over clearance, G/b";
    C: "C", "length", "slow amplitude of the oscillator";
    B: "B", "length", "amplitude of the absorber's sawtooth; of an orbit, b - x_0";
    E: "E", "length", "amplitude of the first harmonic of the sawtooth";
    beta: r"\beta", "1", "amplitude of the absorber over clearance, B/b";
    u: "u", "1", "amplitude beyond the clearance, beta - 1";
    c_2: "c_2", "1", "square of the oscillator's amplitude on the manifold over b^2";
    w_2: "w_2", "1", "square of the distance from the fold, ((1 + R) (beta - beta at the fold))^2";
    k: "k", "1/length", "sensitivity of the impact time";
    tr: r"\mathrm{tr}", "1", "trace of the half-period map of the impact pair";
    det: r"\det", "1", "determinant of a half-period map";
    B_fold: r"B_{\mathrm{fold}}", "length", "amplitude of the absorber at the fold";
    C_fold: r"C_{\mathrm{fold}}", "length", "amplitude of the oscillator at the fold";
    beta_fold: r"\beta_{\mathrm{fold}}", "1", "beta at the fold";
    u_fold: r"u_{\mathrm{fold}}", "1", "u at the fold";
    beta_c: r"\beta_c", "1", "beta at symmetry breaking";
    u_c: r"u_c", "1", "u at symmetry breaking";
    p_0: "p_0", "1", "gamma^2 of a fixed point: constant part of the quadratic in beta";
    p_1: "p_1", "1", "gamma^2 of a fixed point: coefficient of beta";
    p_2: "p_2", "1", "gamma^2 of a fixed point: coefficient of beta^2";
    beta_SN: r"\beta_{\mathrm{SN}}", "1", "beta at which two motions meet";
    gamma_SN: r"\gamma_{\mathrm{SN}}", "1", "gamma at which two motions meet";
    gamma_H: r"\gamma_{\mathrm{H}}", "1", "gamma at which a fixed point reaches the fold";
    gamma_c: r"\gamma_c", "1", "gamma at which a fixed point reaches symmetry breaking";
    sigma_P1: r"\sigma_{\mathrm{P1}}", "1", "detuning at which two fixed points meet at the fold";
    Delta: r"\Delta", "1", "quarter of the discriminant of a quadratic in beta";
    beta_1: r"\beta_1", "1", "smaller beta of two motions";
    beta_2: r"\beta_2", "1", "larger beta of two motions";
    n_0: "n_0", "1", "root of p_2 times gamma_SN: constant part in sigma";
    n_2: "n_2", "1", "root of p_2 times gamma_SN: coefficient of sigma^2";
    s_0: "s_0", "1", "detunings of a saddle-node: constant part";
    s_1: "s_1", "1", "detunings of a saddle-node: coefficient of sigma";
    s_2: "s_2", "1", "detunings of a saddle-node: coefficient of sigma^2";
    s_3: "s_3", "1", "detunings of a saddle-node: coefficient of sigma^3";
    s_4: "s_4", "1", "detunings of a saddle-node: coefficient of sigma^4";
    a_1: "a_1", "1", "in phase with the absorber, the forcing that a fixed point needs without detuning";
    f_0: "f_0", "1", "detunings of a fixed point: constant part";
    f_1: "f_1", "1", "detunings of a fixed point: coefficient of sigma";
    f_2: "f_2", "1", "detunings of a fixed point: coefficient of sigma^2";
    tr_J: r"\mathrm{tr} J", "1", "trace of the slow flow's Jacobian";
    det_J: r"\det J", "1", "determinant of the slow flow's Jacobian";
    ell: r"\ell", "1", "energy that two impacts per cycle take, over beta^2, as a rate of c_2";
    Lambda: r"\Lambda", "1", "coefficient of beta^2 in the rate of a free decay";
    q: "q", "1", "root of a discriminant in a free decay";
    Q: "Q", "1", "rate at which c_2 falls in a free decay";
    Q_i: r"Q_{\mathrm{i}}", "1", "Q at the beginning of a decay";
    Q_f: r"Q_{\mathrm{f}}", "1", "Q at the end of a decay";
    beta_i: r"\beta_{\mathrm{i}}", "1", "beta at the beginning of a decay";
    beta_f: r"\beta_{\mathrm{f}}", "1", "beta at the end of a decay";
    Psi: r"\Psi", "1", "difference of two arctangents over q in a free decay";
    s_d: r"s_{\mathrm{d}}", "1", "constant part of a quotient in the energy of a free decay";
    W: "W", "1", "fall of c_2 that impacts take in a free decay";
    c: "c", "1", "slow amplitude of the oscillator over clearance, C/b";
    S: "S", "1", "mean force of the absorber that takes energy, E sin(Theta) over clearance";
    K: "K", "1", "mean force of the absorber in phase with the displacement, E cos(Theta) over clearance";
    z_c: "z_c", "1", "in-phase part of the slow motion, c cos(eta)";
    z_s: "z_s", "1", "quadrature part of the slow motion, c sin(eta)";
    S_prime: "S'", "1", "derivative of S by c along a branch";
    K_prime: "K'", "1", "derivative of K by c along a branch";
    h_r: r"h_{\mathrm{r}}", "1", "half the distance of two detunings of one amplitude, times 2 c";
    sigma_1: r"\sigma_1", "1", "smaller detuning of an amplitude";
    sigma_2: r"\sigma_2", "1", "larger detuning of an amplitude";
    a: "a", "1", "acceleration of the absorber along its cavity, over b omega0^2";
    f: "f", "1", "friction of the absorber per unit of its mass, over b omega0^2";
    rho_1: r"\rho_1", "1", "rho at the wall w = b";
    rho_2: r"\rho_2", "1", "rho at the wall w = -b";
    rho_m: r"\rho_{\mathrm{m}}", "1", "mean of rho at both walls";
    rho_d: r"\rho_{\mathrm{d}}", "1", "rho at the wall w = b less that at w = -b";
    nu: r"\nu", "rad", "a quarter of the difference of the times of two flights, (t_1 - t_2)/4";
    t_1: "t_1", "rad", "phase of the flight from w = b to w = -b";
    t_2: "t_2", "rad", "phase of the flight from w = -b to w = b";
    n_c: "n_c", "1", "side of the equation of c_c";
    d_c: "d_c", "1", "factor of c_c in its equation";
    c_c: r"c_{\mathrm{c}}", "1", "c times the cosine of the phase midway from w = b to w = -b";
    c_s: r"c_{\mathrm{s}}", "1", "c times the sine of the phase midway from w = b to w = -b";
    v_T: "v_T", "1", "velocity that gravity and friction give the absorber in a cycle";
    u_1: "u_1", "1", "velocity of the absorber after the impact at w = b";
    u_2: "u_2", "1", "velocity of the absorber after the impact at w = -b";
    x_1: "x_1", "1", "displacement of the oscillator at the impact at w = b, over clearance";
    v_1: "v_1", "1", "velocity of the oscillator at the impact at w = b, over clearance";
    x_2: "x_2", "1", "displacement of the oscillator at the impact at w = -b, over clearance";
    v_2: "v_2", "1", "velocity of the oscillator at the impact at w = -b, over clearance";
    g_1: "g_1", "1", "change of the absorber's velocity by the phase of the impact at w = b, over relative velocity";
    g_2: "g_2", "1", "change of the absorber's velocity by the phase of the impact at w = -b, over relative velocity";
    tr_c: r"\mathrm{tr}_{\mathrm{c}}", "1", "trace of the impact pair's map over a cycle";
    h_PD: r"h_{\mathrm{PD}}", "1", "above 0 while no multiplier is below -1";
    x_w: "x_w", "1", "displacement of the oscillator where the absorber turns back in flight, over clearance";
    h_g: r"h_{\mathrm{g}}", "1", "how far beyond the wall w = b the absorber turns back in flight, over clearance";
    M: "M", "1", "part of the absorber's first harmonic that impacts change sign by sign";
    N: "N", "1", "part of the absorber's first harmonic that friction and gravity make";
    c_fold: r"c_{\mathrm{fold}}", "1", "amplitude of the oscillator over clearance at the fold";
    kappa: r"\kappa", "1", "dynamic stiffness of the oscillator, 1 - Omega^2";
    delta: r"\delta", "1", "damping force of the oscillator per displacement, epsilon lambda Omega";
    P_s: "P_s", "length", "coefficient of sin in the excitation";
    P_c: "P_c", "length", "coefficient of cos in the excitation";
    X_s: "X_s", "length", "coefficient of sin(phi) in the steady motion";
    X_c: "X_c", "length", "coefficient of cos(phi) in the steady motion";
    chi: r"\chi", "1", "amplitude of the steady motion without impacts over gamma b";
    L_2: "L_2", "1", "square of the steady amplitude without impacts over b^2, (gamma chi)^2";
    g: "g", "1", "displacement of the free oscillator at T/2 after a unit of velocity";
    g_dot: r"\dot{g}", "1", "velocity of the free oscillator at T/2 after a unit of velocity";
    h: "h", "1", "1 + g_dot, small near resonance and computed without the difference";
    q_1: "q_1", "1", "displacement right after an impulse of one that repeats every T/2 with opposite sign";
    q_2: "q_2", "1", "velocity right after an impulse of one that repeats every T/2 with opposite sign";
    v_after: "v_{+}", "1", "velocity of the oscillator after an impact over the absorber's speed";
    v_before: "v_{-}", "1", "velocity of the oscillator before an impact over the absorber's speed";
    A: "A", "1", "loss of steady displacement at an impact per beta b";
    D: "D", "1", "loss of steady velocity over Omega at an impact per beta b";
    X: "X", "length", "displacement of the steady motion at an impact on the wall +b";
    V: "V", "length", "velocity of the steady motion over Omega at an impact on the wall +b";
    x_0: "x_0", "length", "displacement of the oscillator at an impact on the wall +b";
    y_0: "y_0", "length", "displacement of the absorber at an impact on the wall +b";
    x_dot_before: r"\dot{x}^{-}", "length", "velocity of the oscillator before an impact on the wall +b, in fast time";
    x_dot_after: r"\dot{x}^{+}", "length", "velocity of the oscillator after an impact on the wall +b, in fast time";
    y_dot_before: r"\dot{y}^{-}", "length", "velocity of the absorber before an impact on the wall +b, in fast time";
    y_dot_after: r"\dot{y}^{+}", "length", "velocity of the absorber after an impact on the wall +b, in fast time";
    w_dot_before: r"\dot{w}^{-}", "length", "relative velocity before an impact";
    w_dot_after: r"\dot{w}^{+}", "length", "relative velocity after an impact";
    x: "x", "length", "displacement of the oscillator";
    x_dot: r"\dot{x}", "length", "velocity of the oscillator in fast time";
    x_dot_dot: r"\ddot{x}", "length", "acceleration of the oscillator in fast time";
    y_dot_dot: r"\ddot{y}", "length", "acceleration of the absorber in fast time";
    dw: r"\mathrm{d}w", "length", "small change of the relative displacement at the end of a flight";
    dtau: r"\mathrm{d}\tau", "1", "small change of the length of a flight in fast time";
    D1_C: r"\mathrm{D}_1 C", "length", "slow rate of the oscillator's amplitude";
    D1_c: r"\mathrm{D}_1 c", "1", "slow rate of the oscillator's amplitude over clearance";
    D1_eta: r"\mathrm{D}_1 \eta", "1", "slow rate of the excitation's phase";
    D1_z_c: r"\mathrm{D}_1 z_c", "1", "slow rate of z_c";
    D1_z_s: r"\mathrm{D}_1 z_s", "1", "slow rate of z_s";
    D1_c_2: r"\mathrm{D}_1 c_2", "1", "slow rate of the square of the oscillator's amplitude over b^2";
    D1_beta: r"\mathrm{D}_1 \beta", "1", "slow rate of the absorber's amplitude over clearance";
    Theta: r"\Theta", "rad", "phase of the absorber against the oscillator";
    eta: r"\eta", "rad", "phase of the excitation against the oscillator";
    phi: r"\varphi", "rad", "phase Omega tau of the excitation at an impact on the wall +b";
    tau: r"\tau", "1", "fast time, omega0 t";
    tau_1: r"\tau_1", "1", "slow time, epsilon tau";
}

impl std::fmt::Display for Symbol {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.entry().name)
    }
}
