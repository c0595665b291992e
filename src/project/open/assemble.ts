/** Assembles a character from the files that belong to it, and reports parts that don't fit. */
import { lostOver } from '../../edit/carried-over.ts';
import { withSkeleton } from '../../edit/new-character.ts';
import { withoutUnkeyed } from '../../edit/unkeyed.ts';
import { checkClip, checkMorph, checkSkin } from '../../evaluate/binding.ts';
import { guessSharedSpace } from '../../evaluate/space.ts';
import type { ChannelClip } from '../../model/clip.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Character, isBvh, shownClip, shownSkin } from '../../model/document.ts';
import { jointDofCount } from '../../model/dofs.ts';
import {
  baseName,
  type CapturedFigure,
  folderOf,
  type ParsedFile,
  type SourceFile,
  sameName,
} from '../../model/files.ts';
import { NO_MARKS, type PartFile, type PartMark, type PartMarks, readAs, UNMARKED } from '../../model/part.ts';
import { positionsMeant, positionsTaken, withPositions } from '../../model/position-channels.ts';

/**
 * Adds a part, or replaces the one read from a file of the same name; new parts are shown.
 * @param before the character before these files were opened: only its parts are replaced, so two new files of the same
 * name become two parts
 */
export function withPart(character: Character, file: ParsedFile, before: Character | undefined): Character {
  const replaced = (s: SourceFile) => sameName(s.name, file.source.name) && (before?.sources.includes(s) ?? false);
  const next = { ...character, sources: [...character.sources.filter((s) => !replaced(s)), file.source] };
  switch (file.kind) {
    case 'skin': {
      const { name } = file.skin;
      const at = replacedIndex(next.skins, before?.skins, name);
      const parts = withMark(next, 'skins', at, { kind: 'skin', source: file.source, holds: name });
      return { ...next, parts, skins: put(next.skins, at, file.skin), shownSkin: at < 0 ? next.skins.length : at };
    }
    case 'morph': {
      const { name } = file.morph;
      const at = replacedIndex(next.morphs, before?.morphs, name);
      const parts = withMark(next, 'morphs', at, { kind: 'morph', source: file.source, holds: name });
      const pose = at < 0 ? [...next.pose, 0] : next.pose;
      return { ...withoutUnkeyed(next), parts, morphs: put(next.morphs, at, file.morph), pose };
    }
    case 'anim':
      return withClip(withoutUnkeyed(next), file.clip, { kind: 'anim', source: file.source }, before);
    case 'skel':
    case 'bvh':
    case 'rig':
    case 'pose':
    case 'texture':
      return next;
  }
}

/** Adds a clip from a file and shows it. */
function withClip(
  character: Character,
  clip: ChannelClip,
  file: Omit<PartFile, 'holds'>,
  before: Character | undefined,
): Character {
  const { clips } = character;
  const at = replacedIndex(clips, before?.clips, clip.name);
  const parts = withMark(character, 'clips', at, { ...file, holds: clip.name });
  return { ...character, parts, clips: put(clips, at, clip), shownClip: at < 0 ? clips.length : at };
}

/** The marks with that of a part from a file, replacing the one at `at`, or appended if `at` is -1. */
function withMark(character: Character, key: 'skins' | 'morphs' | 'clips', at: number, file: PartFile): PartMarks {
  const { parts = NO_MARKS } = character;
  const marks = character[key].map((_, i) => parts[key][i] ?? UNMARKED);
  return { ...parts, [key]: put(marks, at, readAs(marks[at], file)) };
}

interface Named {
  readonly name: string;
}

/** Index of the part of that name that existed before; -1 if none did. */
function replacedIndex(parts: readonly Named[], before: readonly Named[] | undefined, name: string): number {
  return parts.findIndex((part) => part.name === name && before?.includes(part));
}

function put<T>(list: readonly T[], at: number, item: T): readonly T[] {
  return at < 0 ? [...list, item] : list.map((old, i) => (i === at ? item : old));
}

/** Gives a character's skins the textures that they name; the same character if there are none. */
export function withTextures(character: Character, given: readonly ParsedFile[]): Character {
  const skinFolders = character.parts?.skins.flatMap(({ file }) => (file ? folderOf(file.source) : [])) ?? [];
  let next = character;
  for (const skin of character.skins) {
    const wanted = skin.material?.texture;
    if (wanted === undefined) continue;
    const fits = given.filter((f) => f.kind === 'texture' && sameName(f.source.name, baseName(wanted)));
    const file = fits.find((f) => skinFolders.includes(folderOf(f.source))) ?? fits[0];
    if (file?.kind !== 'texture' || next.textures.includes(file.texture)) continue;
    next = {
      ...next,
      textures: [...next.textures.filter((t) => !sameName(t.name, file.texture.name)), file.texture],
      sources: [...next.sources.filter((s) => !sameName(s.name, file.source.name)), file.source],
    };
  }
  return next;
}

/**
 * Uses a figure of a file: its skeleton, and its clip as the shown one. Motion capture does not say how its space is
 * oriented or scaled, so that is guessed and can be changed. An existing setting is kept when the file is opened again.
 * @param together all figures of the file; they share one space
 */
export function withFigure(
  character: Character,
  figure: CapturedFigure,
  file: Omit<PartFile, 'holds'>,
  before: Character | undefined,
  together: readonly CapturedFigure[] = [figure],
): Character {
  const { skeleton, clip } = figure;
  const { parts = NO_MARKS } = character;
  const mark = readAs(parts.skeleton, { ...file, holds: skeleton.name });
  const fitted = { ...withSkeleton(character, skeleton), parts: { ...parts, skeleton: mark } };
  const next = !isBvh({ skeleton })
    ? fitted
    : { ...fitted, space: before?.space ?? guessSharedSpace(together.map(asMeant)) };
  return clip ? withClip(next, clip, file, before) : next;
}

/** With the position channels as the file's writer meant them: the size of a collapsed figure can't be measured. */
function asMeant({ skeleton, clip }: CapturedFigure): CapturedFigure {
  const meant = withPositions(skeleton, positionsMeant(skeleton, clip));
  return clip ? { skeleton: meant, clip } : { skeleton: meant };
}

/** Reports parts of a character that don't fit; only pairs of which at least one is new. */
export function checkParts(before: Character | undefined, after: Character): Diagnostic[] {
  const problems: Diagnostic[] = [];
  const newSkeleton = before?.skeleton !== after.skeleton;
  const { parts = NO_MARKS } = after;
  const called = (mark: PartMark | undefined, otherwise: string) => mark?.file?.source.name ?? otherwise;
  if (before && newSkeleton && after.skeleton) {
    problems.push(...lostOver(before, after, called(parts.skeleton, `${after.skeleton.name}.skel`)));
  }
  if (newSkeleton && after.skeleton && positionsTaken(after.skeleton) === 'replace') {
    if (positionsMeant(after.skeleton, shownClip(after)) === 'add') {
      const message =
        'Position channels stay near 0 where OFFSETs do not, as if meant to be added to OFFSET. ' +
        'If the figure looks collapsed, change "Positions" in the Character section.';
      const file = called(parts.skeleton, `${after.skeleton.name}.bvh`);
      problems.push(withoutPlace('info', 'positions-near-zero', message, file, 'positions replace offsets'));
    }
  }
  after.skins.forEach((skin, i) => {
    const isNew = !before?.skins.includes(skin);
    const file = called(parts.skins[i], `${skin.name}.skin`);
    if (after.skeleton && (isNew || newSkeleton)) problems.push(...checkSkin(skin, after.skeleton, file));
    const texture = skin.material?.texture;
    if (isNew && texture !== undefined && !after.textures.some((t) => sameName(t.name, baseName(texture)))) {
      const message = `The texture "${texture}" named by the skin was not among the files.`;
      problems.push(withoutPlace('warning', 'texture-not-given', message, file, 'drawn without texture'));
    }
  });
  const skin = shownSkin(after);
  after.morphs.forEach((morph, i) => {
    const isNew = !before?.morphs.includes(morph) || (skin && !before.skins.includes(skin));
    if (skin && isNew) problems.push(...checkMorph(morph, skin, called(parts.morphs[i], `${morph.name}.morph`)));
  });
  const clip = shownClip(after);
  const needsAnother = newSkeleton && jointDofCount(before?.skeleton) !== jointDofCount(after.skeleton);
  if (clip && after.skeleton && (needsAnother || !before?.clips.includes(clip))) {
    const file = called(parts.clips[after.shownClip], `${clip.name}.anim`);
    problems.push(...checkClip(clip, after.skeleton, after.morphs.length, file));
  }
  return problems;
}
