/** What *Help > Other programs* says is what the manual says, and of the versions that the tests use. */
import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { READ_FROM, SAVED_FOR } from '../../../../src/ui/shell/help/programs-page.ts';

const read = (name: string) => readFileSync(new URL(`../../../../${name}`, import.meta.url), 'utf8');

it('the manual has the table of other programs that the page has', () => {
  const manual = read('docs/guide/other-programs.md').split('\n');
  for (const { file, program, seen } of [...SAVED_FOR, ...READ_FROM]) {
    expect(manual).toContain(`| ${file} | ${program} | ${seen} |`);
  }
});

it('the versions of other programs are those that the tests use', () => {
  const { devDependencies } = JSON.parse(read('package.json'));
  const programs = SAVED_FOR.map(({ program }) => program);
  const minor = (version: string) => version.split('.').slice(0, 2).join('.');
  expect(programs).toContain(`three.js ${minor(devDependencies.three)}`);
  expect(programs).toContain(`Babylon.js ${minor(devDependencies['@babylonjs/core'])}`);
  expect(programs).toContain(`Khronos validator ${devDependencies['gltf-validator']}`);
  expect(programs).toContain(`Chromium ${devDependencies['@sparticuz/chromium'].split('.')[0]}`);
});
