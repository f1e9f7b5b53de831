/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

namespace tool {

/** \brief How the page looks: light or dark as its reader likes it, and on paper. */
constexpr const char* PAGE_STYLE = R"css(
:root {
  color-scheme: light dark;
  --page: #f6f7f9; --card: #ffffff; --text: #1d2430; --quiet: #5d6776;
  --line: #dfe3e9; --cell: #f3f5f8; --bar: #cfe0f5;
  --kept: #2472c8; --rejected: #d9650b; --refused: #8d97a5; --failed: #a33bb0;
  --good: #17795e; --part: #a85c00; --picture: #eef1f5;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #14171c; --card: #1d2128; --text: #e6e9ee; --quiet: #9aa4b2;
    --line: #323944; --cell: #242a33; --bar: #27466b;
    --kept: #5ba3f0; --rejected: #f5923e; --refused: #7b8592; --failed: #d07ddb;
    --good: #4cc3a0; --part: #f0a640; --picture: #262c35;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0; background: var(--page); color: var(--text);
  font: 15px/1.5 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
}
main { max-width: 1080px; margin: 0 auto; padding: 28px 20px 48px; }
h1 { font-size: 29px; line-height: 1.25; margin: 0 0 4px; letter-spacing: -0.01em; }
h1::before {
  content: ""; display: inline-block; width: 15px; height: 15px; margin-right: 12px;
  border-radius: 50%; background: var(--good);
}
h1.part::before { background: var(--part); }
h2 { font-size: 19px; margin: 0 0 10px; }
h3 { font-size: 16px; margin: 18px 0 6px; }
p { margin: 6px 0; }
section {
  background: var(--card); border: 1px solid var(--line); border-radius: 12px;
  padding: 18px 20px; margin: 18px 0;
}
section.advice { border-left: 4px solid var(--part); }
.quiet, figcaption { color: var(--quiet); }
.facts { display: flex; flex-wrap: wrap; gap: 6px 26px; margin: 10px 0 0; padding: 0;
  list-style: none; color: var(--quiet); }
.facts b { color: var(--text); font-variant-numeric: tabular-nums; }
.pictures { display: grid; grid-template-columns: repeat(3, 1fr); gap: 12px; }
figure { margin: 0; }
figure img { display: block; width: 100%; background: var(--picture);
  border-radius: 8px; }
figcaption { font-size: 13px; margin-top: 5px; }
.ruler { height: 5px; margin: 6px 0 0; border: 1.5px solid var(--quiet);
  border-top: 0; }
.chips { display: flex; flex-wrap: wrap; gap: 4px 14px; margin: 12px 0 0;
  font-size: 13px; }
.scan { display: inline-flex; align-items: center; gap: 7px; }
.chip { flex: none; min-width: 22px; padding: 0 5px; border-radius: 11px;
  color: #14171c; font-size: 12px; line-height: 19px; text-align: center; }
svg { display: block; width: 100%; height: auto; }
svg text { fill: var(--text); font-size: 11px; text-anchor: middle; }
svg .cell { fill: var(--cell); stroke: var(--line); }
svg .cell-title { fill: var(--quiet); font-size: 12px; text-anchor: start; }
svg .axis { stroke: var(--quiet); }
svg line.kept { stroke: var(--kept); }
svg line.rejected { stroke: var(--rejected); stroke-dasharray: 7 4; }
svg line.refused { stroke: var(--refused); stroke-dasharray: 2 3; }
svg rect.kept { fill: var(--kept); }
svg rect.rejected { fill: var(--rejected); }
svg rect.refused { fill: var(--refused); }
svg line:hover { stroke-opacity: 0.6; }
svg .node circle { stroke: var(--card); stroke-width: 1.5; }
svg .node text { fill: #14171c; font-weight: 600; font-size: 10.5px; }
svg .unusable { opacity: 0.45; }
.histogram { max-width: 560px; }
.key { display: flex; flex-wrap: wrap; gap: 4px 22px; margin: 10px 0 0; font-size: 13px;
  color: var(--quiet); }
.key svg { display: inline-block; width: 34px; height: 10px; margin-right: 7px; }
.scroll { overflow-x: auto; }
table { width: 100%; border-collapse: collapse; font-size: 13.5px; }
th { text-align: left; font-weight: 600; color: var(--quiet); white-space: nowrap; }
th, td { padding: 5px 10px; border-bottom: 1px solid var(--line); vertical-align: top; }
tr > :first-child { padding-left: 2px; }
tbody tr:last-child td { border-bottom: 0; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.bar { background: linear-gradient(var(--bar), var(--bar)) no-repeat 0 6px /
  var(--share) 1.35em; }
.file { overflow-wrap: anywhere; color: var(--quiet); }
.words { min-width: 230px; width: 40%; }
.more { color: var(--quiet); font-style: italic; }
details { margin: 8px 0; }
summary { cursor: pointer; padding: 4px 0; }
.verdict { font-weight: 650; }
.verdict.kept { color: var(--kept); } .verdict.rejected { color: var(--rejected); }
.verdict.refused { color: var(--quiet); } .verdict.failed { color: var(--failed); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 2px 18px; margin: 0;
  font-size: 13.5px; }
dt { color: var(--quiet); } dd { margin: 0; overflow-wrap: anywhere; }
code { font-size: 0.93em; }
@media (max-width: 720px) { .pictures { grid-template-columns: 1fr; } }
@media print {
  :root {
    --page: #fff; --card: #fff; --text: #000; --quiet: #444; --line: #ccc;
    --cell: #f6f6f6; --bar: #d5e3f5; --picture: #f4f4f4; --kept: #2472c8;
    --rejected: #d9650b; --refused: #8d97a5; --failed: #a33bb0; --good: #17795e;
    --part: #a85c00;
  }
  body { font-size: 11px; -webkit-print-color-adjust: exact;
    print-color-adjust: exact; }
  main { padding: 0; max-width: none; }
  section { border: 0; padding: 0; }
  table, dl { font-size: 9.5px; }
  th { white-space: normal; }
  figure, tr, svg { break-inside: avoid; }
  h2, h3, summary { break-after: avoid; }
}
)css";

} // namespace tool
