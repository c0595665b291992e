/** Checks of the page that run in more than one browser: they are in `tests/e2e/checks/`. */
import { it } from 'vitest';
import { type OpenPage, type PageOptions, withPage } from './page.ts';

/** One test. */
export interface Check {
  /** A sentence, continued from `in Firefox, `. */
  readonly name: string;
  readonly options?: PageOptions;
  run(open: OpenPage): Promise<void>;
}

/** Registers the checks as tests of Chromium. */
export function testAll(checks: readonly Check[]): void {
  for (const { name, options, run } of checks) it(name, () => withPage(run, options));
}
