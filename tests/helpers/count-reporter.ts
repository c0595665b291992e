/**
 * The last line of a test run: `123 passed, 0 failed`. Before it, the tests that passed at a second try only; and first,
 * where there is no Firefox, that its tests are no part of a run of the browsers.
 */
import type { Reporter, TestModule, TestSpecification } from 'vitest/node';
import { firefoxPath } from './firefox-path.ts';

export default class CountReporter implements Reporter {
  onTestRunStart(specifications: readonly TestSpecification[]): void {
    if (specifications.some(({ project }) => project.name === 'browser') && !firefoxPath())
      console.log('Firefox not found: its tests are no part of this run (set MARROW_FIREFOX).');
  }

  onTestRunEnd(modules: readonly TestModule[], unhandled: readonly unknown[]): void {
    let passed = 0;
    let skipped = 0;
    // An error outside any test fails the run too.
    let failed = unhandled.length;
    for (const module of modules) {
      let inside = 0;
      for (const test of module.children.allTests()) {
        const { state } = test.result();
        if (state === 'passed') passed++;
        else if (state === 'failed') inside++;
        else skipped++;
        if (test.diagnostic()?.flaky)
          console.log(`Passed at the second try only: ${test.fullName} (${module.relativeModuleId})`);
      }
      // A file that failed to load has no tests that could fail.
      failed += inside || (module.state() === 'failed' ? 1 : 0);
    }
    console.log(`${passed} passed, ${failed} failed${skipped ? `, ${skipped} skipped` : ''}`);
  }
}
