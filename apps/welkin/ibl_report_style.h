#pragma once
#include <string_view>

// The style sheet of the report page: light and dark by the reader's preference, wide tables scroll by themselves.

namespace welkin {

inline constexpr std::string_view report_style = R"css(
:root { color-scheme: light dark; --paper: #fbfaf8; --card: #ffffff; --ink: #22242a; --faint: #666a73; --line: #dedcd6;
  --accent: #9a5b00; --warn: #fff3d6; }
@media (prefers-color-scheme: dark) { :root { --paper: #1a1b1e; --card: #222327; --ink: #e2e0da; --faint: #9ea1a8;
  --line: #3a3c42; --accent: #f2b85c; --warn: #3b301a; } }
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem 1rem 4rem; font: 16px/1.5 system-ui, sans-serif;
  background: var(--paper); color: var(--ink); }
h1 { margin: 0; font-size: 1.7rem; overflow-wrap: anywhere; }  h2 { margin: 2.4rem 0 .6rem; font-size: 1.15rem; color: var(--accent); }
p { margin: .4rem 0; max-width: 48rem; }  .faint, caption, figcaption { color: var(--faint); }
* { box-sizing: border-box; }  img { display: block; max-width: 100%; height: auto; border-radius: 6px; }
figure { margin: 1.2rem 0; }  figcaption { font-size: .9rem; }  .warnings { margin: 1rem 0; padding: .7rem 1rem .7rem 2rem; background: var(--warn); border-radius: 6px; }
table { border-collapse: collapse; background: var(--card); font-size: .9rem; font-variant-numeric: tabular-nums; }
caption { caption-side: bottom; padding-top: .4rem; text-align: left; font-size: .85rem; }  a { color: var(--accent); }
th, td { padding: .35rem .7rem; border: 1px solid var(--line); text-align: left; vertical-align: top; }
.bar { display: block; height: .7rem; min-width: 2px; background: var(--accent); }
thead th { white-space: nowrap; }  .wide { min-width: 12rem; }  .scroll { overflow-x: auto; }  .n { text-align: right; white-space: nowrap; }
pre { overflow-x: auto; padding: 1rem; background: var(--card); font: .85rem/1.45 ui-monospace, monospace; }
)css";

}  // namespace welkin
