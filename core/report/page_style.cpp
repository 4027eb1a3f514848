#include "report/page_style.h"

namespace mrose {

const std::string_view reportStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #fbfbfa; --card: #ffffff; --ink: #1b1e23; --soft: #5b626d; --rule: #dcdfe4; --grid: #eceef1; --warn: #8a4b00; --warnpage: #fff3df;
  --real: #f0a828; --realarrow: #9e5c00; --c0: #0072b2; --c1: #d55e00; --c2: #009e73; --c3: #b0578d; --c4: #b37a00; --c5: #4d4d4d;
  --k0: #9aa3ad; --k1: #56b4e9; --k2: #d55e00;
}
@media (prefers-color-scheme: dark) { :root {
  --page: #14171b; --card: #1b1f25; --ink: #e8eaed; --soft: #a2aab5; --rule: #353b44; --grid: #272c34; --warn: #ffc66d; --warnpage: #3a2c12;
  --real: #b9842a; --realarrow: #ffd27f; --c0: #56b4e9; --c1: #f0803c; --c2: #2fc79b; --c3: #dd92bd; --c4: #f0b429; --c5: #b9bec6;
  --k0: #717a86; --k1: #56b4e9; --k2: #f0803c;
} }
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 16px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 28px 24px 64px; }
h1 { font-size: 27px; line-height: 1.2; margin: 0 0 4px; font-weight: 650; letter-spacing: -.01em; }
h2 { font-size: 19px; margin: 44px 0 6px; font-weight: 650; }
h3 { font-size: 15.5px; margin: 0 0 6px; font-weight: 600; }
p { margin: 6px 0 10px; max-width: 86ch; }
.soft, .sub { color: var(--soft); }
.sub { margin: 0 0 18px; overflow-wrap: anywhere; }
.lead { font-size: 17px; line-height: 1.5; margin: 14px 0; }
.badge { display: inline-block; font-size: 12.5px; font-weight: 650; padding: 1px 9px; border-radius: 9px; background: var(--warnpage); color: var(--warn); border: 1px solid var(--warn); vertical-align: 4px; margin-left: 8px; }
.notice { background: var(--warnpage); color: var(--warn); border-left: 4px solid var(--warn); padding: 8px 14px; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(210px, 1fr)); gap: 12px; margin: 18px 0 8px; }
.tile, .card { background: var(--card); border: 1px solid var(--rule); border-radius: 8px; }
.tile { padding: 12px 16px 10px; }
.tile .name { font-size: 14px; color: var(--soft); }
.tile .value { font-size: 30px; line-height: 1.25; font-weight: 650; font-variant-numeric: tabular-nums; }
.tile .value small { font-size: 16px; font-weight: 500; color: var(--soft); }
.tile .more { font-size: 13.5px; color: var(--soft); line-height: 1.4; }
.card { padding: 14px 16px; min-width: 0; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 460px), 1fr)); gap: 14px; }
.paths { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 340px), 1fr)); gap: 14px; }
.paths .soft { font-size: 13.5px; margin: 0 0 4px; line-height: 1.4; }
.bars + .bars, .pair + .pair, .pair + .card { margin-top: 14px; }
.warn { color: var(--warn); } .paths + .legend { margin-top: 12px; } .legend + .card { margin-top: 14px; }
.paths + p { margin-top: 16px; } .paths .plot { margin: 0 auto; } .paths table + .soft { margin-top: 10px; }
.closeups { display: grid; grid-template-columns: repeat(auto-fill, minmax(140px, 1fr)); gap: 12px 16px; } .closeup { font-size: 14px; } .closeup svg { margin-top: 4px; background: var(--page); border-radius: 6px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14.5px; font-variant-numeric: tabular-nums; width: 100%; }
th, td { padding: 4px 8px; text-align: right; border-bottom: 1px solid var(--grid); white-space: nowrap; }
th:first-child { text-align: left; padding-left: 0; }
thead th { font-weight: 500; color: var(--soft); border-bottom: 1px solid var(--rule); vertical-align: bottom; }
tr.groups th { border-bottom: none; text-align: center; padding-bottom: 0; color: var(--ink); }
tbody th { font-weight: 500; }
tr.part th { font-size: 13.5px; color: var(--soft); font-weight: 500; padding-top: 12px; }
td small { display: block; color: var(--soft); font-size: 12.5px; line-height: 1.2; }
td b { font-weight: 700; }
table.words td { text-align: left; white-space: normal; overflow-wrap: anywhere; }
table.words th { vertical-align: top; width: 1%; padding-right: 26px; }
table.dense { font-size: 14px; } table.dense :is(th, td):not(:first-child) { padding: 4px 5px; }
table.even td { width: 8%; }
table.files td, table.files th { text-align: left; white-space: normal; }
table.small { font-size: 13.5px; }
table.small th, table.small td { padding: 2px 5px; }
table.small tbody th { white-space: normal; line-height: 1.25; }
table.small th:first-child { padding-left: 0; } table.small :is(th, td):last-child { padding-right: 1px; }
tbody tr:last-child > * { border-bottom: none; }
.model { display: inline-flex; align-items: center; gap: 8px; }
a { color: inherit; }
code { font: 13.5px/1.45 ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 20px; margin: 8px 0 10px; font-size: 14.5px; align-items: center; }
.legend span { display: inline-flex; align-items: center; gap: 7px; }
.legend svg { flex: none; }
svg.plot { display: block; width: 100%; height: auto; overflow: visible; }
.scene { display: flex; flex-wrap: wrap; gap: 12px 28px; align-items: center; justify-content: center; } .scene > svg { display: block; flex: 0 1 auto; max-width: 100%; height: auto; border-radius: 6px; } .scene > div { flex: 1 1 300px; min-width: 0; max-width: 560px; }
svg text { font-family: system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
:where(svg.plot, .legend svg) text { fill: var(--ink); }
text.tick { font-size: 13px; fill: var(--soft); font-variant-numeric: tabular-nums; }
text.title { font-size: 14px; fill: var(--ink); }
text.middle { text-anchor: middle; } text.end { text-anchor: end; }
path.grid { stroke: var(--grid); stroke-width: 1; fill: none; }
path.axis { stroke: var(--soft); stroke-width: 1.2; fill: none; }
.line { fill: none; stroke: var(--c); stroke-width: 1.8; stroke-linejoin: round; stroke-linecap: round; }
.s0 { --c: var(--c0); stroke-width: 2.4; } .s1 { --c: var(--c1); stroke-dasharray: 7 4; } .s2 { --c: var(--c2); stroke-dasharray: 2 4; }
.s3 { --c: var(--c3); stroke-dasharray: 10 3 2 3; } .s4 { --c: var(--c4); stroke-dasharray: 14 4; } .s5 { --c: var(--c5); stroke-dasharray: 1 3; }
.real { --c: var(--real); stroke-width: 6; }
.thin { stroke-width: 1.4; opacity: .85; }
.band { fill: var(--c0); stroke: none; opacity: .15; } .band.inner { opacity: .24; }
.arrow { stroke: var(--c); fill: var(--c); stroke-width: 1.3; stroke-dasharray: none; } .arrow.real { --c: var(--realarrow); }
.start { fill: var(--card); stroke: var(--ink); stroke-width: 2; }
.leaves { fill: var(--card); stroke: var(--c1); stroke-width: 2.6; }
.miss { stroke: var(--soft); stroke-width: 1.2; stroke-dasharray: 2 3; }
.floorline { --c: var(--soft); stroke-width: 1.4; stroke-dasharray: 5 3; }
rect.k0 { fill: var(--k0); } rect.k1 { fill: var(--k1); } rect.k2 { fill: var(--k2); }
.realband { fill: var(--real); stroke: none; opacity: .28; } .realband.inner { opacity: .5; }
.edge { stroke-width: 1.6; stroke-dasharray: none; } .edge.outer { stroke-width: 1.4; stroke-dasharray: 5 3; }
.realdot { fill: var(--real); opacity: .6; } .realmark { fill: var(--real); stroke: var(--card); stroke-width: 1; } .realmiss { --c: var(--realarrow); stroke-width: 1.4; }
.mark { fill: var(--c0); } .sample { fill: var(--c0); opacity: .55; } .subject { fill: var(--ink); } .unreported { fill: var(--card); stroke: var(--ink); stroke-width: 1.6; }
.body { fill: var(--k0); opacity: .6; } .own { fill: var(--ink); } .arc { --c: var(--rule); stroke-width: 1; } .sight { --c: var(--soft); stroke-width: 1.2; stroke-dasharray: 5 3; } .sight.over { --c: #fff; }
rect.even { fill: var(--c0); opacity: .55; } .nothing { fill: var(--grid); }
.v0 { fill: #440154; } .v1 { fill: #482878; } .v2 { fill: #3e4989; } .v3 { fill: #31688e; } .v4 { fill: #26828e; }
.v5 { fill: #1f9e89; } .v6 { fill: #35b779; } .v7 { fill: #6ece58; } .v8 { fill: #b5de2b; } .v9 { fill: #fde725; }
details { margin: 8px 0; } summary { cursor: pointer; color: var(--soft); }
dl { display: grid; grid-template-columns: minmax(120px, max-content) 1fr; gap: 6px 22px; margin: 8px 0; max-width: 110ch; }
dt { font-weight: 600; } dd { margin: 0; }
@media (max-width: 640px) { main { padding: 18px 14px 40px; } dl { grid-template-columns: 1fr; gap: 2px; } dd { margin-bottom: 8px; } }
@media print { body { background: #fff; } .card, .tile { break-inside: avoid; } main { max-width: none; padding: 0; } }
)css";

}  // namespace mrose
