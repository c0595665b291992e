/**
 * Small files of the kinds that people brought and that once were refused or wrong: `cases.json` in ../shared says what
 * is right for each, and this asks the command.
 */
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, it } from 'vitest';
import { describeShared, sharedBytes, sharedPath } from '../helpers/shared.ts';
import { CHECKS, type FieldCase } from './checks.ts';

describeShared('files from the field', () => {
  const folder = sharedPath('data/field/');
  const scratch = mkdtempSync(join(tmpdir(), 'marrow-field-'));
  afterAll(() => rmSync(scratch, { recursive: true, force: true }));

  // The file is fixed; each check reads its own members.
  const cases = JSON.parse(new TextDecoder().decode(sharedBytes('data/field/cases.json'))) as FieldCase[];

  it.each(cases.map((one) => [one.case, one] as const))('%s', async (_, one) => {
    await CHECKS[one.check](one, folder, mkdtempSync(join(scratch, 'case-')));
  });
});
