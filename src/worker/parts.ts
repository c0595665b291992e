/** What was read, in parts: the page takes over each in a few milliseconds, and draws and listens between them. */
import type { ParsedFile } from '../model/files.ts';
import { passageOf } from './passage.ts';
import type { KnownSkin, ParsedPart, ParseOutput } from './protocol.ts';
import { forMessage, withCharacters } from './tracked-takes.ts';

/** Of a part, unless a single file has more: 5 to 10 ms to clone. */
const MAX_WEIGHT = 8192;

interface Part extends ParsedPart {
  readonly files: [file: ParsedFile, index: number][];
  readonly facts: KnownSkin[];
}

/** A part, and the buffers that are transferred with it. */
export interface PostedPart {
  readonly part: ParsedPart;
  readonly transfer: ArrayBuffer[];
}

/** All files of an output, and what is known of their skins. */
export function partsOf(output: Pick<ParseOutput, 'files' | 'facts'>): readonly PostedPart[] {
  const posted: { readonly part: Part; readonly buffers: Set<ArrayBuffer> }[] = [];
  let weight = Number.POSITIVE_INFINITY;
  for (const family of familiesIn(output)) {
    const passage = passageOf(family);
    if (weight + passage.weight > MAX_WEIGHT) {
      posted.push({ part: { files: [], facts: [] }, buffers: new Set() });
      weight = 0;
    }
    weight += passage.weight;
    const { part, buffers } = posted[posted.length - 1];
    for (const [file, index] of family.files) part.files.push([withCharacters(file, forMessage), index]);
    part.facts.push(...family.facts);
    for (const buffer of passage.transfer) buffers.add(buffer);
  }
  // A buffer can be transferred once: one of several parts is cloned.
  const uses = new Map<ArrayBuffer, number>();
  for (const { buffers } of posted) for (const buffer of buffers) uses.set(buffer, (uses.get(buffer) ?? 0) + 1);
  return posted.map(({ part, buffers }) => ({ part, transfer: [...buffers].filter((each) => uses.get(each) === 1) }));
}

/** Skins with the morphs that were measured on them, which must be the same objects on the other side; others alone. */
function familiesIn({ files, facts }: Pick<ParseOutput, 'files' | 'facts'>): readonly Part[] {
  const families = new Map<object, Part>();
  for (const known of facts) {
    const members = [known.skin, ...known.morphs];
    const found = members.map((member) => families.get(member)).find((family) => family !== undefined);
    const family = found ?? { files: [], facts: [] };
    family.facts.push(known);
    for (const member of members) families.set(member, family);
  }
  const all = new Set<Part>();
  for (const [index, file] of files.entries()) {
    const found = measuredIn(file)
      .map((member) => families.get(member))
      .find((family) => family !== undefined);
    const family = found ?? { files: [], facts: [] };
    family.files.push([file, index]);
    all.add(family);
  }
  return [...all];
}

function measuredIn(file: ParsedFile): readonly object[] {
  if (file.kind === 'skin') return [file.skin];
  if (file.kind === 'morph') return [file.morph];
  return file.kind === 'character' ? file.characters.flatMap(({ skins, morphs }) => [...skins, ...morphs]) : [];
}
