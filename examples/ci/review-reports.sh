#!/usr/bin/env bash
# Reviews the design reports of a change: are they up to date, what changed, does every criterion hold?
#
#   review-reports.sh BASE [CASE...]      BASE: the branch that the change goes to, such as origin/main
#
# Writes a comment for the review to $REVIEW. Needs vinesink and git, and BASE's history; touches
# nothing else. Cases are cases/*.toml unless named.
# Exit codes: 0 all is well, 1 a criterion fails or a report is not up to date, 2 could not be done.
set -euo pipefail

base="${1:?the branch that the change goes to, such as origin/main}"
shift
if [ $# -eq 0 ]; then
    shopt -s nullglob
    set -- cases/*.toml
    if [ $# -eq 0 ]; then
        echo "there is no case: cases/*.toml names no file here" >&2
        exit 2
    fi
fi
# The folder with the reports, and the file that receives the comment.
reports="${REPORTS:-reports}"
review="${REVIEW:-review.md}"
# Address under which the forge shows files, without it figures are named and not shown:
# https://github.com/OWNER/NAME/raw, https://gitlab.example/GROUP/NAME/-/raw.
raw_url="${RAW_URL:-}"
# `github` marks failed criteria in the list of changed files.
check_format="${CHECK_FORMAT:-text}"

# What an earlier run left is no review of this change.
rm -f "$review"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# Carries out a command that says with 1 that something does not hold; 2 and more end the script.
holds() {
    local code=0
    "$@" || code=$?
    if [ "$code" -ge 2 ]; then exit 2; fi
    return "$code"
}

# Changes of others since the branch was made are not this one's.
if ! since="$(git merge-base "$base" HEAD)"; then
    echo "git finds no commit that \`$base\` and HEAD have in common: fetch the whole history" >&2
    echo "(fetch-depth: 0 on GitHub, GIT_DEPTH: 0 on GitLab)" >&2
    exit 2
fi
# The forge counts folders from the root of the repository.
shown="$(git rev-parse --show-prefix)$reports"

failed=0
new="$reports"
new_url="${raw_url:+$raw_url/$(git rev-parse HEAD)/$shown}"
if ! holds vinesink report --check --out "$reports" -- "$@" >"$work/stale"; then
    failed=1
    # What the reports should be is reviewed; it is in no commit, so its figures have no address.
    new="$work/reports"
    new_url=""
    if [ -d "$reports" ]; then cp -R "$reports" "$new"; fi
    holds vinesink report --out "$new" -- "$@" >/dev/null || true
fi

differences=(vinesink diff "$since" "$new" --path "$reports")
if [ -n "$raw_url" ]; then differences+=(--old-url "$raw_url/$since/$shown"); fi
if [ -n "$new_url" ]; then differences+=(--new-url "$new_url"); fi
holds "${differences[@]}" >"$work/diff" || true

holds vinesink check --format "$check_format" -- "$@" >"$work/check" && criteria=hold || criteria=fail
cat "$work/check"

{
    # The comment is found again by its first line.
    echo "<!-- vinesink-review -->"
    if [ "$criteria" = fail ]; then
        failed=1
        printf '**A criterion fails**; the log says which, and below stands whether it failed before too.\n\n'
    fi
    if [ -s "$work/stale" ]; then
        printf '**Reports are not up to date**; commit what `vinesink report` writes. Compared is what it would write.\n\n'
        printf '<details>\n<summary>Which</summary>\n\n'
        # A comment may have 65,536 characters, and the differences up to 60,000.
        # Indented lines stay code whatever is in them; a fence ends where a name of a file has one.
        lines="$(wc -l <"$work/stale")"
        {
            head -n 15 "$work/stale"
            if [ "$lines" -gt 15 ]; then echo "and $((lines - 15)) more"; fi
        } | sed 's/^/    /'
        printf '\n</details>\n\n'
    fi
    cat "$work/diff"
} >"$review"
exit "$failed"
