/**
 * *Reload from disk*: files of a character that changed on disk are read again and replace their parts, as one step. If
 * none has changed, edits are reverted to what the files hold.
 */
import type { Store } from '../edit/store.ts';
import { formatKindOf } from '../files/kinds.ts';
import type { DiskFile } from '../io/disk-files.ts';
import type { GivenFile } from '../io/given.ts';
import { partsOf } from '../model/character-parts.ts';
import { type Diagnostic, hasErrors, withoutPlace } from '../model/diagnostic.ts';
import { type Character, findCharacter } from '../model/document.ts';
import { sentenceOf } from '../model/failure.ts';
import { baseName } from '../model/files.ts';
import type { Messages } from '../ui/state/messages.ts';
import { canReload, type DiskHandles } from './disk-handles.ts';
import type { Opener } from './opening.ts';
import type { Unsaved } from './unsaved.ts';

export interface ReloadParts {
  readonly store: Store;
  readonly messages: Pick<Messages, 'note' | 'report'>;
  readonly opener: Pick<Opener, 'open'>;
  readonly unsaved: Unsaved;
  readonly handles: DiskHandles;
  /** `readAgain` of `io/disk-access.ts`. */
  readAgain(file: DiskFile, signal: AbortSignal): Promise<GivenFile>;
}

/** Returns all diagnostics, as opening does; never rejects. */
export async function reload(parts: ReloadParts, characterId: string): Promise<readonly Diagnostic[]> {
  const { store, messages, opener } = parts;
  const character = findCharacter(store.document, characterId);
  if (!character || !canReload(store.document, parts.handles, characterId)) {
    messages.note('This character has no files to reload.', 'warning');
    return [];
  }
  let names: readonly string[] | undefined;
  let before = store.document;
  const failures: Diagnostic[] = [];
  const diagnostics = await opener.open(
    async (signal) => {
      const { changed, found } = await changedFiles(parts, character, failures, signal);
      names = changed.map(({ path }) => baseName(path));
      before = store.document;
      return withNeeded(changed, found);
    },
    { reloads: character.id },
  );
  if (failures.length) messages.report(failures);
  else if (names?.length === 0) messages.note('Nothing has changed on disk.');
  else if (names && store.document !== before && !hasErrors(diagnostics)) {
    messages.note(`Reloaded ${names.join(', ')}.`);
  }
  return [...failures, ...diagnostics];
}

/**
 * The current files: all that can be read, and those of them to be read again; the others are listed in `failures`.
 */
async function changedFiles(
  { handles, unsaved, readAgain }: ReloadParts,
  character: Character,
  failures: Diagnostic[],
  signal: AbortSignal,
): Promise<{ readonly changed: readonly GivenFile[]; readonly found: readonly GivenFile[] }> {
  const files = handles.ofCharacter(character);
  const read = await Promise.all(
    files.map(async (file) => {
      try {
        return { file, now: await readAgain(file, signal) };
      } catch (error) {
        signal.throwIfAborted();
        const message = sentenceOf(error);
        failures.push(withoutPlace('error', 'reload-failed', `Not reloaded. ${message}`, baseName(file.path)));
        return undefined;
      }
    }),
  );
  const readable = read.filter((r) => r !== undefined);
  const found = readable.map(({ now }) => now);
  const changed = readable.filter(({ file, now }) => now.version === undefined || now.version !== file.version);
  if (changed.length || failures.length) return { changed: changed.map(({ now }) => now), found };
  const edited = editedFiles(character, handles, unsaved);
  return { changed: readable.filter(({ file }) => edited.has(file)).map(({ now }) => now), found };
}

/** With the other files that a `.gltf` is read from, if any of these has changed. */
function withNeeded(changed: readonly GivenFile[], found: readonly GivenFile[]): readonly GivenFile[] {
  const kindOf = ({ path }: GivenFile) => formatKindOf(baseName(path));
  const isGltf = (file: GivenFile) => kindOf(file) === 'gltf';
  // Its buffers are of no kind of their own.
  const isOfGltf = (file: GivenFile) => isGltf(file) || ['texture', undefined].includes(kindOf(file));
  if (!changed.some(isOfGltf) || !found.some(isGltf)) return changed;
  return found.filter((file) => changed.includes(file) || isOfGltf(file));
}

/** The files whose parts have unsaved edits; markers are beside them. */
function editedFiles(character: Character, handles: DiskHandles, unsaved: Unsaved): ReadonlySet<DiskFile | undefined> {
  const parts = partsOf(character);
  const own = unsaved.current().filter((part) => part.characterId === character.id && !part.isMarkers);
  return new Set(own.map(({ kind, index }) => handles.ofPart(parts.filter((p) => p.kind === kind)[index])));
}
