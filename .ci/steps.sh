# What `.ci/run` and `.ci/deep` share; they source it from the root of the repository.
set -euo pipefail
exec </dev/null
export CARGO_TERM_COLOR=never
# Nothing is built twice here: what would help a second build only costs time.
export CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_CODEGEN_UNITS=256
target="$(realpath -m "${CARGO_TARGET_DIR:-target}")"

# step NAME: a headline, and where the seconds of this step begin.
step_names=() step_begins=()
step() {
    step_names+=("$1") step_begins+=("$SECONDS")
    printf '\n== %s (after %d s) ==\n' "$1" "$SECONDS"
}

# How many seconds each step took.
seconds_of_steps() {
    printf '\n== seconds ==\n'
    local k end
    for k in "${!step_names[@]}"; do
        end="${step_begins[k + 1]:-$SECONDS}"
        printf '%6d  %s\n' "$((end - step_begins[k]))" "${step_names[k]}"
    done
    printf '%6d  all\n' "$SECONDS"
}

# debian PACKAGE ...: installs the packages that are missing. One whose program of the same name is there already, wherever it
# comes from, is not.
debian() {
    local package missing=()
    for package in "$@"; do
        command -v "$package" >/dev/null || dpkg -s "$package" >/dev/null 2>&1 || missing+=("$package")
    done
    if [ "${#missing[@]}" -gt 0 ]; then
        apt-get update -qq && apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
    fi
}

# Python's environments with the packages that tests and checks use.
environment() {
    python3 -c "import ensurepip" 2>/dev/null || debian python3-venv
    [ -x "$target/python/bin/python" ] || python3 -m venv "$target/python"
    "$target/python/bin/pip" install --quiet --disable-pip-version-check "$@"
}

components() {
    cargo fmt --version && cargo clippy --version
}

tools() {
    components 2>/dev/null || rustup component add rustfmt clippy
    cargo --version
    # The oldest Rust that is promised is the one that everything here is built with.
    local promised
    promised="$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)"
    case "$(rustc --version)" in
    "rustc $promised."*) ;;
    *)
        echo "Cargo.toml promises Rust $promised, which $(rustc --version) does not test" >&2
        return 1
        ;;
    esac
}

# timed COMMAND ...: runs `cargo test` so that each test says how long it took, and lists the slowest. The option is
# one of unstable Rust's, which the test program alone is told of.
timed() {
    local host log code=0
    host="$(rustc -vV | sed -n 's/^host: //p' | tr a-z- A-Z_)"
    log="$(mktemp)"
    env "CARGO_TARGET_${host}_RUNNER=$PWD/.ci/timed" "$@" 2>&1 | tee "$log" || code=$?
    printf '\n== the 30 slowest tests, in seconds ==\n'
    # All is read: a program whose reader leaves early may fail of it, and the gate with it.
    sed -nE 's/^test (.*) \.\.\. ok <([0-9.]+)s>$/\2 \1/p' "$log" | sort -rn | sed -n 1,30p
    rm "$log"
    return "$code"
}
