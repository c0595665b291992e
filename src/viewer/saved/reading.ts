/** In the place of `../reading.ts` in a saved page, which has its files, no worker, and no network. */
import { adoptSkinFacts } from '../../evaluate/skin/bounds.ts';
import { readCharacters } from '../../files/web-page/read-characters.ts';
import type { Shown } from '../../files/web-page/shown-characters.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { EMPTY_DOCUMENT } from '../../model/document.ts';
import { UserError } from '../../model/user-error.ts';
import type { GivenBlob, OpenOutput } from '../../worker/protocol.ts';
import { openedOf } from '../opened.ts';
import type { Held } from '../reading.ts';

export function holdFiles(): Held {
  return { opened: Promise.reject(new UserError('A saved page shows its own files alone.')), release: () => undefined };
}

export function holdGiven(files: readonly GivenBlob[]): Held {
  return { opened: read(files), release: () => undefined };
}

async function read(given: readonly GivenBlob[]): Promise<OpenOutput> {
  const shown: readonly Shown[] = JSON.parse(document.querySelector('pre[data-shown]')?.textContent ?? '[]');
  const files = await Promise.all(
    given.map(async ({ path, blob }) => ({ path, bytes: new Uint8Array(await blob.arrayBuffer()) })),
  );
  const { characters, diagnostics } = readCharacters(files, shown);
  const errors = diagnostics.filter((one) => hasErrors([one]));
  const output = openedOf({ ...EMPTY_DOCUMENT, characters }, errors);
  for (const { skin, facts, morphs } of output.facts) adoptSkinFacts(skin, facts, morphs);
  return output;
}

export function useWorker(): () => void {
  return () => undefined;
}
