/** Styles of the HTML report: the page's own colours, sizes and fonts. */
export const STYLE = `
:root {
  color-scheme: light dark;
  --ground: light-dark(#e9ebee, #191b1e);
  --surface: light-dark(#f6f7f8, #212427);
  --field: light-dark(#ffffff, #15171a);
  --hover: light-dark(#e6e9ec, #30353a);
  --line: light-dark(#d7dbe0, #32373c);
  --text: light-dark(#1c2126, #e3e6ea);
  --text-faint: light-dark(#565f69, #9aa3ac);
  --accent: light-dark(#5b46d6, #a594ff);
  --right: light-dark(#2a6b17, #85cf63);
  --error: light-dark(#b3261e, #ff8a80);
  --warning: light-dark(#7d5700, #f2c14e);
  --info: light-dark(#1f56bd, #8ab8ff);
}
* { box-sizing: border-box; }
body {
  margin: 0 auto;
  padding: 24px;
  max-width: 1280px;
  background: var(--ground);
  color: var(--text);
  font: 13px/20px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "Noto Sans", sans-serif;
  font-variant-numeric: tabular-nums;
}
h1 { margin: 0; font-size: 20px; line-height: 28px; }
h2 { margin: 16px 0 0; font-size: 20px; line-height: 28px; display: flex; gap: 12px; align-items: center; }
h3 { margin: 0 0 8px; font-size: 13px; overflow-wrap: anywhere; }
p { margin: 4px 0 0; }
a { color: var(--accent); }
a:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; border-radius: 2px; }
code, pre, .formula { font: 12px/20px ui-monospace, "SF Mono", "Cascadia Mono", Menlo, Consolas, monospace; overflow-wrap: anywhere; }
pre { margin: 4px 0 0; padding: 4px 8px; background: var(--field); border: 1px solid var(--line); border-radius: 4px; overflow-x: auto; overflow-wrap: normal; }
.faint { color: var(--text-faint); }
.wide { margin-top: 16px; overflow-x: auto; background: var(--surface); border: 1px solid var(--line); border-radius: 4px; }
table { width: 100%; border-collapse: collapse; }
th, td { padding: 4px 12px; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
tbody tr:last-child > * { border-bottom: 0; }
tbody tr:hover { background: var(--hover); }
thead th { color: var(--text-faint); font-weight: 500; white-space: nowrap; }
tbody th { font-weight: 600; overflow-wrap: anywhere; min-width: 96px; }
.number { white-space: nowrap; }
.badge { display: inline-block; padding: 0 8px; border: 1px solid currentColor; border-radius: 10px; font-size: 11px; font-weight: 600; line-height: 18px; white-space: nowrap; }
.badge.right { color: var(--right); }
.badge.wrong { color: var(--error); }
.badge.incomplete, .badge.not-judged { color: var(--warning); }
.page { display: none; }
.page:target { display: block; }
body:has(.page:target) #overview { display: none; }
nav { display: flex; flex-wrap: wrap; gap: 4px 24px; }
article { margin-top: 16px; padding: 12px 16px; background: var(--surface); border: 1px solid var(--line); border-radius: 4px; }
dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 4px 16px; margin: 0; }
dt { color: var(--text-faint); }
dd { margin: 0; overflow-wrap: anywhere; }
.numbers { display: flex; flex-wrap: wrap; gap: 4px 32px; margin: 12px 0 0; }
.numbers figcaption { width: 100%; color: var(--text-faint); }
.numbers table { width: auto; }
.numbers caption { text-align: left; font-weight: 600; }
.numbers td { text-align: right; font-family: ui-monospace, "SF Mono", "Cascadia Mono", Menlo, Consolas, monospace; }
.numbers .differs { color: var(--error); font-weight: 600; }
.cause { margin-top: 12px; padding-left: 12px; border-left: 2px solid var(--accent); }
ul { margin: 0; padding: 0; list-style: none; }
li + li { margin-top: 8px; }
li.error > b { color: var(--error); }
li.warning > b { color: var(--warning); }
p.warning { color: var(--warning); }
li.info > b { color: var(--info); }
@media (max-width: 600px) {
  body { padding: 12px; }
  dl { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dd { margin-bottom: 8px; }
}
@media print {
  :root { color-scheme: light; }
  body { max-width: none; padding: 0; background: none; }
  .page { display: block; break-before: page; }
  body:has(.page:target) #overview { display: block; }
  nav { display: none; }
}
`;
