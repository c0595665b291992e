import { describe, expect, it } from 'vitest';
import { sentenceOf } from '../../src/model/failure.ts';
import { WorkerError } from '../../src/worker/client.ts';

function thrown(run: () => unknown): unknown {
  try {
    run();
  } catch (error) {
    return error;
  }
  throw new Error('Nothing was thrown.');
}

describe('what failed', () => {
  it('a browser’s own errors about memory are told in one sentence of ours', () => {
    const odd = Number.MAX_SAFE_INTEGER;
    const errors = [
      thrown(() => new ArrayBuffer(odd)),
      thrown(() => new Float64Array(odd)),
      thrown(() => 'a'.repeat(2 ** 30)),
      thrown(() => structuredClone(() => undefined)),
      new DOMException(
        "Failed to execute 'postMessage' on 'Worker': Data cannot be cloned, out of memory.",
        'DataCloneError',
      ),
      // As Firefox and Safari put it.
      new RangeError('invalid or out-of-range array length'),
      new RangeError('Out of memory'),
    ];
    for (const error of errors)
      expect(sentenceOf(error)).toBe('There is not enough memory for this. Close other tabs, or use smaller files.');
  });

  it('nesting without an end is told as such', () => {
    const deep = (): number => 1 + deep();
    expect(sentenceOf(thrown(deep))).toBe('This is nested too deeply.');
  });

  it('a file that has gone is told as such', () => {
    const gone = new DOMException('A requested file or directory could not be found.', 'NotFoundError');
    expect(sentenceOf(gone)).toMatch(/^The file has moved/);
  });

  it('what a browser refuses, can’t fetch, or fails at unexpectedly is told in sentences of ours', () => {
    expect(sentenceOf(new DOMException('', 'NotAllowedError'))).toBe('The browser does not allow it.');
    const imports = [
      new TypeError('Failed to fetch dynamically imported module: https://a.b/c.js'),
      // As Firefox and Safari put it.
      new TypeError('error loading dynamically imported module: https://a.b/c.js'),
      new TypeError('Importing a module script failed.'),
    ];
    for (const error of imports) expect(sentenceOf(error)).toMatch(/^Part of the page could not be loaded/);
    const call = "Failed to execute 'createObjectURL' on 'URL': Overload resolution failed.";
    expect(sentenceOf(new TypeError(call))).toBe(`Something went wrong. Try again. (TypeError: ${call})`);
    const odd = new DOMException('x'.repeat(1000), 'UnknownError');
    expect(sentenceOf(odd)).toMatch(/^Something went wrong\. Try again\. \(UnknownError: x{100,160}\)$/);
  });

  it('our own sentences stay as they are, also where they speak of lengths and memory', () => {
    const own = 'Expected an array length of 3, found 4.';
    expect(sentenceOf(new Error(own))).toBe(own);
    expect(sentenceOf(new WorkerError(own))).toBe(own);
    expect([sentenceOf('text'), sentenceOf(undefined)]).toEqual(['text', 'undefined']);
  });
});
