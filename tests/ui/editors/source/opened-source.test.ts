import { describe, expect, it } from 'vitest';
import { OpenedSource } from '../../../../src/ui/editors/source/opened-source.ts';
import type { SourceFiles } from '../../../../src/ui/state/source.ts';

/** Gives bytes at once, and reads on until `end` is called. */
function filesOf(bytes: Uint8Array<ArrayBuffer>) {
  let end: () => void = () => undefined;
  const ended = new Promise<void>((resolve) => {
    end = resolve;
  });
  const files: Partial<SourceFiles> = {
    given: () => undefined,
    read: async (_path, _signal, onText) => {
      onText(new Blob([bytes]));
      await ended;
      throw new Error('The file has ended early.');
    },
  };
  // Only these are asked for.
  return { files: files as SourceFiles, end };
}

describe('a file that is shown', () => {
  it('that is no text, and can not be read to its end either, says so once', async () => {
    const { files, end } = filesOf(Uint8Array.of(65, 0, 66));
    const said: string[] = [];
    const source: OpenedSource = new OpenedSource('a.skel', files, {
      onLines: () => said.push('lines'),
      onText: () => said.push('text'),
      onState: () => said.push(source.state.kind),
    });
    const read = source.read();
    // The first lines are refused meanwhile; nobody waits for that yet.
    await new Promise((resolve) => setImmediate(resolve));
    await new Promise((resolve) => setImmediate(resolve));
    end();
    await read;
    expect(said).toEqual(['failed']);
    expect(source.state).toEqual({ kind: 'failed', message: 'The file has ended early.' });
  });
});
