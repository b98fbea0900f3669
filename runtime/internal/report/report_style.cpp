#include "samara/internal/report/report_style.hpp"

namespace samara {

// Pictures are drawn on white; in the dark they are turned to black, with their hues kept.
const char* const report_style = R"css(
:root {
    color-scheme: light dark;
    --ink: #1f2933; --soft: #5f6b77; --line: #d9dee4; --paper: #ffffff; --card: #f4f6f8; --picture: #ffffff;
    --good: #0b7a4b; --limited: #9a5b00; --bad: #b3261e;
}
@media (prefers-color-scheme: dark) {
    :root {
        --ink: #e6eaee; --soft: #a0abb6; --line: #38424c; --paper: #14181c; --card: #1d2328; --picture: #141414;
        --good: #5fd3a0; --limited: #f0b35a; --bad: #ff8a80;
    }
    figure img { filter: invert(0.92) hue-rotate(180deg); }
}
* { box-sizing: border-box; }
body {
    margin: 0 auto; max-width: 74rem; padding: 2rem 1.5rem 4rem;
    color: var(--ink); background: var(--paper); font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif;
}
h1 { margin: 0; font-size: 1.9rem; line-height: 1.2; overflow-wrap: anywhere; }
h2 { margin: 3rem 0 0.8rem; font-size: 1.3rem; scroll-margin-top: 1rem; }
h3 { margin: 1.2rem 0 0.3rem; font-size: 1rem; }
p { margin: 0.5rem 0; max-width: 60rem; }
.below { color: var(--soft); overflow-wrap: anywhere; }
.verdict { margin: 1.5rem 0; padding: 1.3rem 1.6rem 1.5rem; background: var(--card); border-left: 0.5rem solid; border-radius: 0.4rem; }
.verdict.good { border-color: var(--good); }
.verdict.limited { border-color: var(--limited); }
.verdict.bad { border-color: var(--bad); }
.verdict > p { margin: 0; font-size: 1.35rem; font-weight: 600; }
.uses { display: grid; grid-template-columns: repeat(auto-fit, minmax(20rem, 1fr)); gap: 0 2.5rem; }
.uses ul { margin: 0; padding-left: 1.2rem; }
.uses li { margin: 0.25rem 0; }
.uses h3.good, td.good, dt.good { color: var(--good); }
.uses h3.bad, dt.bad { color: var(--bad); }
dt.limited { color: var(--limited); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.35rem 1.4rem; margin: 0; }
dt { font-weight: 600; white-space: nowrap; }
dt::before { display: inline-block; width: 1.4em; }
dt.good::before { content: "\2713"; }
dt.limited::before { content: "~"; }
dt.bad::before { content: "\2717"; }
dd { margin: 0; overflow-wrap: anywhere; }
nav { display: flex; flex-wrap: wrap; gap: 0.3rem 1.2rem; }
a { color: inherit; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 0.92rem; }
th, td { padding: 0.28rem 1.3rem 0.28rem 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
thead th { color: var(--soft); font-weight: 500; }
tbody th { font-weight: 500; white-space: nowrap; }
figure { margin: 0.8rem 0; padding: 0.6rem; background: var(--picture); border: 1px solid var(--line); border-radius: 0.4rem; }
figure img { display: block; width: 100%; height: auto; }
details { margin: 0.8rem 0; }
summary { cursor: pointer; color: var(--soft); }
footer { margin-top: 3.5rem; color: var(--soft); font-size: 0.9rem; }
@media (max-width: 40rem) { dl { grid-template-columns: 1fr; gap: 0; } dd { margin-bottom: 0.7rem; } }
@media print {
    :root { --ink: #000; --soft: #444; --line: #bbb; --paper: #fff; --card: #fff; --picture: #fff; --good: #0b7a4b; --limited: #9a5b00; --bad: #b3261e; }
    figure { break-inside: avoid; }
    figure img { filter: none; }
    body { max-width: none; padding: 0; font-size: 10.5pt; }
    nav { display: none; }
    details::details-content { content-visibility: visible; }
    h2, h3 { break-after: avoid; }
    .verdict { border: 1px solid var(--line); border-left: 0.5rem solid; }
}
)css";

}  // namespace samara
