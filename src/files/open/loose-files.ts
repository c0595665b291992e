/** Opening files that belong to no skeleton among those given with them: characters that are open have them. */
import { hasErrors } from '../../model/diagnostic.ts';
import { findCharacter } from '../../model/document.ts';
import { type ParsedFile, type SourceFile, stemOf } from '../../model/files.ts';
import { openingOf } from '../kinds.ts';
import { checkParts, withTextures } from './assemble.ts';
import { partOpening, withFile } from './contents.ts';
import { bySkinName } from './matching.ts';
import type { Opening } from './opening.ts';
import { fittingCharacter, givePoses, type PoseFile } from './poses.ts';
import { settle } from './settle.ts';

/** Gives skins, morphs and animations to characters; those that need none become characters themselves. */
export function openParts(opening: Opening, files: readonly ParsedFile[]): void {
  const needsCharacter = (file: ParsedFile) => partOpening(file)?.unused !== undefined;
  // Morphs last: the skin they modify may be among the files and come later.
  for (const file of files) if (!needsCharacter(file)) openPart(opening, file);
  for (const file of files) if (needsCharacter(file)) openPart(opening, file);
}

function openPart(opening: Opening, file: ParsedFile): void {
  const { base, selectedId } = opening;
  const characters = opening.characters.all;
  const { onSkin, unused, skeletonFile } = partOpening(file) ?? {};
  if (skeletonFile) {
    openWithSkeleton(opening, file, skeletonFile(file));
    return;
  }
  const fitting = onSkin ? characters.filter((c) => c.skins.length > 0) : characters;
  // Only characters from before can have been selected.
  const meant = findCharacter(base, selectedId) ?? (base.characters.length === 1 ? base.characters[0] : undefined);
  const target =
    opening.characters.withFile(file.source)[0] ??
    (onSkin ? bySkinName(file.source, characters) : undefined) ??
    (meant && opening.characters.current(meant)) ??
    (unused !== undefined && fitting.length === 1 ? fitting[0] : undefined);
  if (target && fitting.includes(target)) settle(opening, target, withFile(target, file, target), [file]);
  else if (unused !== undefined) opening.unused.push({ file, why: unused });
  // Shown by itself; it waits for a skeleton.
  else settle(opening, undefined, withFile(opening.make(stemOf(file.source)), file, undefined), [file]);
}

/** A take that comes with its skeleton: for the character that has it, or a new one. */
function openWithSkeleton(opening: Opening, file: ParsedFile, skeleton: SourceFile | undefined): void {
  const { characters } = opening;
  const target = characters.withFile(file.source)[0] ?? (skeleton && characters.withFile(skeleton)[0]);
  if (target) settle(opening, target, withFile(target, file, target), [file]);
  else settle(opening, undefined, withFile(opening.make(stemOf(skeleton ?? file.source)), file, undefined), [file]);
}

/** Adds poses to the library of a character with matching joints. */
export function openPoses(opening: Opening, file: PoseFile): void {
  const characters = opening.characters.all;
  const fresh = characters.filter((c) => opening.opened.has(c.id));
  const selected = findCharacter(opening.base, opening.selectedId);
  const meant = selected && opening.characters.current(selected);
  const known = opening.characters.withFile(file.source);
  const target = fittingCharacter(file, [...known, ...(meant ? [meant] : []), ...fresh, ...characters]);
  if (!target) {
    opening.unused.push({ file, why: 'No open character has the joints in these poses.' });
    return;
  }
  const { character, diagnostics } = givePoses(target, file, opening.called);
  opening.diagnostics.push(...diagnostics);
  opening.characters.replace(character);
  opening.opened.add(target.id);
  opening.used.add(file);
}

/** Gives files that waited to characters that were just opened, matched by name; the others keep waiting. */
export function takeUpWaiting(opening: Opening): void {
  for (const waiting of opening.waiting) {
    const { file } = waiting;
    if (opening.used.has(file) || file.kind === 'texture' || opening.unused.some((u) => u.file === file)) continue;
    if (file.kind === 'pose') {
      openPoses(opening, file);
      continue;
    }
    if (openingOf(file.kind).as === 'beside') {
      opening.openBeside?.(opening, file);
      continue;
    }
    const fresh = opening.characters.all.filter((c) => opening.opened.has(c.id));
    const target = partOpening(file)?.onSkin ? bySkinName(file.source, fresh) : undefined;
    const next = target && withFile(target, file, target);
    if (target && next && !hasErrors(checkParts(target, next, opening.called))) settle(opening, target, next, [file]);
    else opening.unused.push(waiting);
  }
}

/** Gives textures that came alone, or before, to the skins that name them. */
export function dressAll(opening: Opening): void {
  for (const character of [...opening.characters.all]) {
    const dressed = withTextures(character, opening.textures);
    if (dressed === character) continue;
    opening.characters.replace(dressed);
    opening.opened.add(character.id);
  }
  const shown = opening.characters.all.flatMap((c) => c.textures);
  for (const file of opening.textures) {
    if (file.kind !== 'texture' || shown.includes(file.texture)) continue;
    opening.unused.push({ file, why: 'No open skin uses it as a texture.' });
  }
}
