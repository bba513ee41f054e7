// The report's style sheet.
#pragma once

#include <string_view>

namespace mocap {

inline constexpr std::string_view kReportStyle = R"(
:root { color-scheme: light dark; --bg: #fafaf8; --card: #fff; --fg: #1b1d20; --muted: #666c74;
  --line: #e1e3e6; --shade: #8883; --c0: #2265b5; --c1: #d2542c; --c2: #2c8a5a; --c3: #9a6b12;
  --c4: #7a4aa8; --c5: #3b8799; --c6: #a83b64; --c7: #5d6b1f; }
@media (prefers-color-scheme: dark) { :root { --bg: #141619; --card: #1c1f23; --fg: #e6e8ea;
  --muted: #9aa1a9; --line: #32363c; --shade: #9993; --c0: #63a7f2; --c1: #f58a5f; --c2: #5fc893;
  --c3: #d8ab4a; --c4: #b98ae6; --c5: #6fc1d3; --c6: #e57ba3; --c7: #b3c163; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--fg);
  font: 15px/1.5 system-ui, "Segoe UI", "Helvetica Neue", sans-serif; }
main { max-width: 1080px; margin: 0 auto; padding: 36px 24px 64px; }
h1 { font-size: 28px; line-height: 1.2; margin: 0; letter-spacing: -.01em; }
h2 { font-size: 19px; margin: 44px 0 12px; padding-top: 16px; border-top: 1px solid var(--line); }
h3 { font-size: 14px; margin: 20px 0 6px; }
p { max-width: 72ch; } p.under { color: var(--muted); margin: 4px 0 22px; max-width: none; }
.tiles { display: grid; grid-template-columns: repeat(auto-fill, minmax(184px, 1fr)); gap: 12px;
  margin: 0 0 20px; }
.tile { background: var(--card); border: 1px solid var(--line); border-radius: 8px;
  padding: 12px 14px; }
.tile b { display: block; font-size: 25px; font-weight: 600; line-height: 1.25;
  font-variant-numeric: tabular-nums; white-space: nowrap; }
.tile b small { font-size: 14px; font-weight: 400; color: var(--muted); }
.tile span { display: block; font-size: 13px; color: var(--muted); line-height: 1.35; }
.tile span:first-child { color: var(--fg); font-weight: 500; }
figure { margin: 18px 0; background: var(--card); border: 1px solid var(--line);
  border-radius: 8px; padding: 12px 14px; }
figcaption { font-size: 13px; color: var(--muted); margin-top: 4px; }
figcaption b { color: var(--fg); }
.two { display: grid; grid-template-columns: repeat(auto-fit, minmax(400px, 1fr)); gap: 4px 16px; }
.two > * { min-width: 0; }
svg.plot { display: block; width: 100%; height: auto; }
svg.plot text { font: 11px system-ui, sans-serif; fill: var(--muted); }
svg.plot text.label { fill: var(--fg); font-size: 11.5px; }
.plan svg.plot { max-width: 600px; margin: 0 auto; }
.axis { fill: none; stroke: var(--muted); } .grid { stroke: var(--line); }
.shade { fill: var(--shade); }
.line { fill: none; stroke-width: 1.6; stroke-linejoin: round; stroke-linecap: round; }
.dashed { stroke-dasharray: 4 4; stroke-width: 1.3; stroke-linecap: butt; }
.ring { fill: none; stroke-width: 1.8; }
.c0 { stroke: var(--c0); } .c1 { stroke: var(--c1); } .c2 { stroke: var(--c2); }
.c3 { stroke: var(--c3); } .c4 { stroke: var(--c4); } .c5 { stroke: var(--c5); }
.c6 { stroke: var(--c6); } .c7 { stroke: var(--c7); }
.dot { stroke: none; } .dot.c0 { fill: var(--c0); } .dot.c1 { fill: var(--c1); }
.dot.c2 { fill: var(--c2); } .dot.c3 { fill: var(--c3); }
.timeline { display: block; width: 100%; height: 22px; border-radius: 5px; }
rect.searching, i.searching { fill: #9aa0a6; background: #9aa0a6; }
rect.acquiring, i.acquiring { fill: #e3a72f; background: #e3a72f; }
rect.tracking, i.tracking { fill: #3a9d6a; background: #3a9d6a; }
rect.lost, i.lost { fill: #d64545; background: #d64545; }
.key { font-size: 13px; color: var(--muted); margin: 7px 0 0; max-width: none; }
.key span { margin-right: 18px; white-space: nowrap; }
.key i { display: inline-block; width: 10px; height: 10px; border-radius: 2px; margin-right: 6px; }
i.swatch { display: inline-block; width: 10px; height: 10px; border-radius: 2px;
  margin-right: 8px; }
td.is, th.is { padding-left: 24px; }
summary { cursor: pointer; font-weight: 500; padding: 6px 0; }
.views { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 8px; }
.views div { font-size: 12px; color: var(--muted); max-width: 250px; }
svg.view { display: block; width: 100%; height: auto; border-radius: 4px; background: #222; }
.view path { fill: none; vector-effect: non-scaling-stroke; stroke-linejoin: round;
  stroke-linecap: round; }
.silhouette { stroke: #d4ff2a; stroke-width: 1; } i.silhouette { background: #d4ff2a; }
.view .unknown { fill: url(#hatch); fill-rule: evenodd; } .hatch { fill: #ff7ad9; }
.key i.unknown { background: repeating-linear-gradient(135deg, #333 0 2px, #ff7ad9 2px 4px); }
.part { stroke-width: .9; opacity: .85; } .stick { stroke-width: 1.8; }
.view .left { stroke: #37a8ff; } .view .right { stroke: #ff7b3d; } .view .middle { stroke: #fff; }
i.left { background: #37a8ff; } i.right { background: #ff7b3d; }
.point { fill: #fff; stroke: #0008; stroke-width: .4; }
table { border-collapse: collapse; font-size: 13.5px; font-variant-numeric: tabular-nums;
  width: 100%; }
th { text-align: left; font-weight: 500; color: var(--muted); }
th, td { padding: 3px 8px 3px 0; border-bottom: 1px solid var(--line); }
td.n, th.n { text-align: right; width: 96px; white-space: nowrap; }
td.bar { width: 34%; padding-right: 0; }
.bar i { display: block; height: 9px; border-radius: 2px; background: var(--c2); opacity: .75; }
@media print { body { background: #fff; } figure, .tile, tr { break-inside: avoid; } }
)";

}  // namespace mocap
