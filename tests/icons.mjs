/**
 * `npm run icons`: draws the PNG icons of the installed page from its SVG, with a browser. They are in the repository:
 * run it after changing the SVG.
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { runnerImport } from 'vite';

const { module } = await runnerImport('./tests/helpers/chromium.ts');
const at = (name) => fileURLToPath(new URL(`../public/icons/${name}`, import.meta.url));
const svg = readFileSync(at('icon.svg'), 'utf8');
// Systems crop a maskable icon to their own shape: its background reaches the edges, and its picture stays within a
// circle of 0.8 of the width, as it is.
const ICONS = {
  'icon-192.png': [192, svg],
  'icon-512.png': [512, svg],
  'maskable-512.png': [512, svg.replace(/ rx="[^"]*"/, '')],
};

const browser = await module.launchChromium();
for (const [name, [size, picture]] of Object.entries(ICONS)) {
  const page = await browser.newPage({ viewport: { width: size, height: size } });
  await page.setContent(
    `<style>body { margin: 0 } svg { display: block; width: 100vw; height: 100vh }</style>${picture}`,
  );
  const png = await page.screenshot({ omitBackground: true });
  writeFileSync(at(name), png);
  console.log(`${String(png.length).padStart(8)}  ${name}`);
  await page.close();
}
await browser.close();
