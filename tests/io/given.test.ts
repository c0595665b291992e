import { expect, it } from 'vitest';
import { inFolder } from '../../src/io/given.ts';

let asked = 0;
const most: number[] = [];

/** As much of a file on disk as is asked for: its answer comes later. */
function file(name: string) {
  const getFile = async () => {
    most.push(++asked);
    await new Promise((resolve) => setTimeout(resolve));
    asked--;
    return new File([name], name);
  };
  return { kind: 'file', name, getFile };
}

function folder(name: string, inside: readonly object[]): FileSystemDirectoryHandle {
  const values = async function* () {
    yield* inside;
  };
  // The parts that listing a folder uses.
  return { kind: 'directory', name, values } as unknown as FileSystemDirectoryHandle;
}

it('asks for the files of a folder eight at a time, and returns them in its order', async () => {
  const names = Array.from({ length: 20 }, (_, i) => `a${i}.skel`);
  const [first, ...others] = names.map(file);
  const found = await inFolder(folder('all', [first, folder('deep', [file('b.skel')]), file('.hidden'), ...others]));
  expect(found.map(({ path }) => path)).toEqual(
    ['a0.skel', 'deep/b.skel', ...names.slice(1)].map((name) => `all/${name}`),
  );
  expect(most).toHaveLength(21);
  expect(Math.max(...most)).toBe(8);
});
