/** Names, files and messages that are markup, script, or names of prototypes: all of it is text. */
import { describe, expect, it } from 'vitest';
import { dropFiles, withPage } from '../helpers/page.ts';

declare global {
  interface Window {
    /** Set by anything that runs what is only text. */
    executed?: unknown;
  }
}

/** Without spaces, so that they are names in text formats too. */
const NAMES = [
  '<img/src=x/onerror=window.executed=1>',
  '"><script>window.executed=1</script>',
  "'-(window.executed=1)-'",
  '<svg/onload=window.executed=1>',
  'javascript:window.executed=1',
  '$(window.executed=1)',
  '__proto__',
  'constructor',
  'hasOwnProperty',
  'toString',
];

const skeleton = `balljoint root {
${NAMES.map((name) => `balljoint ${name} { offset 0 1 0 }`).join('\n')}
}`;

/** Takes, skins, materials and textures of these names, and broken files that quote them. */
const files = NAMES.flatMap((name, i) => {
  const file = name.replace(/[/\\]/g, '∕');
  return [
    { name: `${file}.skel`, bytes: `balljoint ${name} { offset 0 ${i} 0 }` },
    { name: `${file}.anim`, bytes: 'animation { range 0 1 numchannels 0 }' },
    { name: `broken ${file}.skel`, bytes: `balljoint ${name} { ${name} }` },
    { name: `${file}.markers.json`, bytes: JSON.stringify({ format: name, markers: [{ name, time: name }] }) },
    {
      name: `${file}.sets.json`,
      bytes: JSON.stringify({ sets: [{ name, color: name, joints: [name], [name]: name }] }),
    },
    {
      name: `${file}.layers.json`,
      bytes: JSON.stringify({
        base: name,
        layers: [{ name, file: name, mode: 'additive', joints: [name], [name]: name }],
      }),
    },
    { name: `${file}.bmp`, bytes: name },
  ];
});

describe('text of files', () => {
  it('names and messages that are markup, script or names of prototypes are shown as they are, and run nowhere', () =>
    withPage(
      async ({ page }) => {
        await page.waitForFunction(() => window.marrow?.characters().length);
        await dropFiles(page, [{ name: 'names.skel', bytes: skeleton }]);
        await page.getByRole('treeitem', { name: NAMES[0] }).waitFor();
        const joints = await page.evaluate(() => window.marrow.characters()[0].joints.map(({ name }) => name));
        expect(joints.slice(1)).toEqual(NAMES);
        for (const name of NAMES) {
          await page.getByRole('treeitem').filter({ hasText: name }).click();
          await page.locator('[role=treeitem][aria-selected=true]').filter({ hasText: name }).waitFor();
        }
        await dropFiles(page, files);
        await expect
          .poll(() => page.evaluate(() => window.marrow.characters().length))
          .toBeGreaterThanOrEqual(NAMES.length);
        await page
          .locator('.message-line')
          .getByRole('button', { name: /more message|Details/ })
          .click();
        // Of many files with errors, most are folded into one message.
        await page.locator('.messages-list').getByText(NAMES[0]).filter({ visible: true }).first().waitFor();
        await page.getByRole('menuitem', { name: 'Save' }).click();
        await page.getByRole('menu', { name: 'Save' }).waitFor();
        await page.keyboard.press('Escape');
        const found = await page.evaluate(() => ({
          executed: window.executed,
          elements: document.querySelectorAll('img, script:not([src]), svg[onload], iframe, [onerror]').length,
          polluted: Object.keys(Object.prototype),
          title: document.title,
        }));
        expect(found).toMatchObject({ executed: undefined, elements: 0, polluted: [] });
      },
      { size: { width: 1280, height: 800 } },
    ));

  it('the page’s policy refuses what would run text, even from its own console', () =>
    withPage(
      async ({ page }) => {
        await page.waitForFunction(() => window.marrow?.characters().length);
        const refused = await page.evaluateHandle(() => {
          const refused: string[] = [];
          document.addEventListener('securitypolicyviolation', ({ effectiveDirective }) =>
            refused.push(effectiveDirective),
          );
          const attempt = (run: () => unknown) => {
            try {
              run();
            } catch {
              // Refused before it is a violation of another rule.
            }
          };
          attempt(() => {
            document.createElement('div').innerHTML = '<img src=x onerror="window.executed=1">';
          });
          attempt(() => new Worker(URL.createObjectURL(new Blob(['']))));
          attempt(() => new Worker('https://elsewhere.example/worker.js'));
          attempt(() => document.body.setAttribute('style', 'color: red'));
          attempt(() => document.body.append(Object.assign(document.createElement('iframe'), { src: '/' })));
          attempt(() => document.body.append(Object.assign(new Image(), { src: '/elsewhere.png' })));
          attempt(() => document.body.setAttribute('onclick', 'window.executed = 1'));
          document.body.click();
          return refused;
        });
        const rules = () => refused.evaluate((all) => [...new Set(all)].sort());
        await expect.poll(rules).toEqual(['frame-src', 'require-trusted-types-for', 'style-src-attr']);
        await expect.poll(() => page.evaluate(() => window.executed)).toBeUndefined();
      },
      { expected: /policy|Policy|TrustedScriptURL|TrustedHTML|404|elsewhere/ },
    ));
});
