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

/**
 * Registers the checks as tests of Chromium.
 *
 * @param inPage for those without options of their own, from `inOnePage`; default: a page for each
 */
export function testAll(checks: readonly Check[], inPage?: (name: string, run: Check['run']) => void): void {
  for (const { name, options, run } of checks) {
    if (inPage && !options) inPage(name, run);
    else it(name, () => withPage(run, options));
  }
}
