#include "actors/judge/report/page_style.hpp"

namespace luxodus {

// Widths are shares of the page and words break, so no table is wider than the paper. Named pages
// (`page: wide`) turn single sheets of a print.
const char* const report_style = R"css(
:root { --ink: #1c2024; --soft: #5c6670; --line: #c9d0d6; --pale: #f3f5f7; --accent: #0b5138; }
* { box-sizing: border-box; }
html { font-family: "Liberation Sans", Arial, Helvetica, "DejaVu Sans", sans-serif;
  color: var(--ink); font-size: 15px; line-height: 1.42; }
body { max-width: 1140px; margin: 0 auto; padding: 2rem 2rem 4rem; background: #fff; }
h1 { font-size: 2rem; line-height: 1.15; margin: 0.2rem 0 0.3rem; letter-spacing: -0.01em; }
h2 { font-size: 1.35rem; margin: 2.6rem 0 0.7rem; padding-bottom: 0.25rem; color: var(--accent);
  border-bottom: 2px solid var(--accent); break-after: avoid; }
h2 .n { display: inline-block; min-width: 2.2rem; }
h2 .a { margin-right: 0.8rem; }
h4 { font-size: 0.92rem; margin: 0.9rem 0 0.3rem; break-after: avoid; }
h3 { font-size: 1.02rem; margin: 1.5rem 0 0.5rem; break-after: avoid; }
p { margin: 0.4rem 0 0.7rem; }
h2 + p { break-after: avoid; }
a { color: inherit; text-decoration: none; }
code, pre { font-family: "Liberation Mono", "DejaVu Sans Mono", monospace; font-size: 0.88em; }
pre { background: var(--pale); border: 1px solid var(--line); padding: 0.6rem 0.8rem;
  white-space: pre-wrap; overflow-wrap: anywhere; }
.kind { color: var(--soft); font-size: 1.05rem; margin: 0; }
.cover { display: flex; justify-content: space-between; gap: 2rem; align-items: flex-start;
  border-bottom: 1px solid var(--line); padding-bottom: 0.8rem; }
.cover img { max-width: 190px; max-height: 80px; flex: none; }
.project { display: grid; grid-template-columns: 1fr 1fr; gap: 0 2rem; margin: 0.8rem 0 1.2rem; }
.project div { display: flex; gap: 0.8rem; padding: 0.22rem 0;
  border-bottom: 1px solid var(--line); }
.project dt { flex: 0 0 7rem; color: var(--soft); }
.project dd { margin: 0; overflow-wrap: anywhere; }
dl { margin: 0; }
.box { display: flex; gap: 1.1rem; align-items: flex-start; border: 2px solid var(--ink);
  padding: 0.9rem 1.1rem; margin: 1rem 0; break-inside: avoid; }
.box > svg { width: 46px; height: 46px; flex: none; }
.box .words { font-size: 1.35rem; font-weight: bold; line-height: 1.25; margin: 0 0 0.3rem; }
.box p { margin: 0.2rem 0; }
.chips { display: flex; flex-wrap: wrap; gap: 0.15rem 1.2rem; }
.notice { background: var(--pale); border-left: 5px solid var(--soft);
  padding: 0.6rem 1rem 0.5rem; margin: 1rem 0; break-inside: avoid; }
.notice h3 { margin: 0 0 0.2rem; }
.notice ul { margin: 0; padding-left: 1.1rem; }
.contents { columns: 2; column-gap: 2.5rem; list-style: none; padding: 0; margin: 0.3rem 0; }
.contents li { break-inside: avoid; border-bottom: 1px dotted var(--line); padding: 0.12rem 0; }
.contents a { display: flex; gap: 0.5rem; }
.contents .n { flex: 0 0 1.6rem; color: var(--soft); }
.contents .a { flex: 0 0 auto; color: var(--soft); }
.contents .t { flex: 1; }
table { border-collapse: collapse; width: 100%; table-layout: fixed; font-size: 0.8rem;
  line-height: 1.3; margin: 0.5rem 0 0.8rem; }
th, td { border-bottom: 1px solid var(--line); padding: 0.2rem 0.4rem; text-align: left;
  vertical-align: top; overflow-wrap: break-word; hyphens: auto; }
thead th { border-bottom: 1.5px solid var(--ink); vertical-align: bottom; color: var(--soft);
  font-weight: bold; font-size: 0.94em; hyphens: manual; overflow-wrap: normal; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
td.n, th.n { text-align: right; }
td.c, th.c { text-align: center; }
table.dense { font-size: 0.72rem; }
table.dense td { padding: 0.1rem 0.3rem; }
table.spacing th, table.spacing td { padding: 0.07rem 0.25rem; font-size: 0.72rem; }
div.product table.facts { font-size: 0.74rem; margin: 0; }
div.product table.facts th, div.product table.facts td { padding: 0.12rem 0.3rem; }

tr.group th { background: var(--pale); padding-top: 0.45rem; break-after: avoid; }
tr.lead { break-after: avoid; }
tr.lead td { border-bottom: 0; }
tr.places td { font-size: 0.74rem; color: var(--soft); break-inside: auto; }
tr.places b { color: var(--ink); font-weight: normal; }
tr.places { break-inside: auto; }
table.facts th { background: none; font-weight: normal; color: var(--soft); }
.id { color: var(--soft); font-size: 0.85em; white-space: nowrap; }
.note { color: var(--soft); font-size: 0.82rem; }
i[lang] { color: var(--soft); }
.v { font-weight: bold; }
.mark { width: 1.05em; height: 1.05em; margin-right: 0.35em; vertical-align: -0.16em; }
figure { margin: 0.7rem 0 1.1rem; break-inside: avoid; }
figure svg, figure img { max-width: 100%; height: auto; display: block; }
figure.plan > svg { width: 100%; border: 1px solid var(--line); }
figure.cover { margin: 0.4rem 0; }
figure.cover { display: block; border: 0; padding: 0; }
figure.cover > svg { margin: 0 auto; }
figure.cover > img { width: 100%; max-width: none; max-height: 80mm; object-fit: contain; }
figure.chart > svg { border: 1px solid var(--line); margin: 0 auto; }
section.product, section.surface { break-inside: avoid; }
div.product { display: grid; grid-template-columns: auto 1fr; gap: 0 1.2rem; align-items: start; }
div.product .drawings { display: flex; gap: 0.6rem; align-items: center; }
div.product svg { display: block; }
figcaption { font-size: 0.8rem; color: var(--soft); margin-top: 0.3rem; }
figcaption b { color: var(--ink); }
.pictures, .maps { display: grid; grid-template-columns: 1fr 1fr; gap: 0.2rem 1.2rem; }
.pictures, .maps { grid-template-columns: 1fr 1fr 1fr; }
.pictures figure, .maps figure { margin: 0.3rem 0 0; }
.maps svg { width: 100%; border: 1px solid var(--line); }
@media print {
  html { font-size: 9.6pt; }
  body { max-width: none; margin: 0; padding: 0; }
  h1 { font-size: 19pt; }
  h2 { margin-top: 1.6rem; font-size: 13.5pt; }
  h2.fresh, section.sheet, section.wide { break-before: page; }
  section.wide { page: wide; }
  section.sheet h3, section.wide h3 { margin-top: 0; }
  table.facts, nav, pre { break-inside: avoid; }
  section.sheet h2, section.wide h2 { margin-top: 0; }
  figure.plan > svg { width: auto; max-height: 165mm; margin: 0 auto; border: 0; }
  figure.chart > svg { border: 0; }
  .contents .p { color: var(--soft); }
  .box .words { font-size: 13pt; }
}
@media screen { .contents .p { display: none; } }
)css";

}  // namespace luxodus
