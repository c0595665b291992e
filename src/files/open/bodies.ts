/** Skins and the morphs that change them, among files that were read: what is measured before they are shown. */
import { type BrokenFile, byFileName, type ParsedFile } from '../../model/files.ts';
import type { Morph } from '../../model/morph.ts';
import type { Skin } from '../../model/skin.ts';
import { ByStem, groupFiles, isRead } from './grouping.ts';

/** A skin with the morphs that it is shown with. */
export interface Body {
  readonly skin: Skin;
  readonly morphs: readonly Morph[];
}

/**
 * The bodies of new characters, each morph once or twice: on the first skin of its character, which is shown, and on
 * the one that it is named after.
 */
export function bodiesIn(files: readonly ParsedFile[], broken: readonly BrokenFile[]): readonly Body[] {
  const given = [...files, ...broken.map((file) => ({ ...file, broken: true as const }))];
  const { groups, loose } = groupFiles(given, byFileName);
  return [
    ...files.flatMap((file) => (file.kind === 'character' ? file.characters.flatMap(ofWhole) : [])),
    ...groups.flatMap(({ parts }) => ofParts(parts.filter(isRead), (all) => all.first)),
    ...ofParts(loose.part.filter(isRead), (all) => all.only),
  ];
}

function ofWhole({ skins, morphs }: { readonly skins: readonly Skin[]; readonly morphs: readonly Morph[] }): Body[] {
  return skins.map((skin, i) => ({ skin, morphs: i === 0 ? morphs : [] }));
}

/** @param shown the skin that all morphs are for */
function ofParts(parts: readonly ParsedFile[], shown: (all: ByStem<Skin>) => Skin | undefined): readonly Body[] {
  const named = new ByStem<Skin>();
  const morphsOf = new Map<Skin, Set<Morph>>();
  for (const file of parts) {
    if (file.kind !== 'skin') continue;
    named.add(file.skin, file.source);
    morphsOf.set(file.skin, new Set());
  }
  const first = shown(named);
  for (const file of parts) {
    if (file.kind !== 'morph') continue;
    for (const skin of [first, named.named(file.source)]) if (skin) morphsOf.get(skin)?.add(file.morph);
  }
  return Array.from(morphsOf, ([skin, morphs]) => ({ skin, morphs: [...morphs] }));
}
