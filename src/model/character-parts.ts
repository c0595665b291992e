/** Splits a character into the parts that are saved separately (`part.ts`). */
import { type Character, isBvh, isOfJoints } from './document.ts';
import { type PartContents, type PartKind, stemOf } from './files.ts';
import { isNamedApart, isSkeletonKind, NO_MARKS, type Part, type PartMark, UNMARKED } from './part.ts';
import { arePoints } from './skeleton/joint-types.ts';
import type { Skeleton } from './skeleton/skeleton.ts';

/** All parts of a character, in the order in which one would open them. */
export function partsOf(character: Character): readonly Part[] {
  const { name, skeleton, skins, morphs, takes, poses, sets, limbs, parts = NO_MARKS } = character;
  const capture = skeleton && isBvh(character) ? skeleton : undefined;
  const isAcclaim = isOfJoints(character, 'asf');
  const isPoints = arePoints(skeleton);
  const captured: Part[] = [];
  const animations: Part[] = [];
  takes.forEach((take, i) => {
    const mark = parts.takes[i];
    if (skeleton && (capture || isAcclaim || isPoints) && !isFrom(mark, 'anim', take.name)) {
      captured.push(part(isPoints ? 'trc' : isAcclaim ? 'amc' : 'bvh', take.name, { skeleton, take }, mark));
    } else animations.push(part('anim', take.name, take, mark));
  });
  // Without a take, the skeleton is saved alone.
  const alone = isPoints ? skeleton : capture;
  if (alone && captured.length === 0) {
    captured.push(part(isPoints ? 'trc' : 'bvh', alone.name, { skeleton: alone }, parts.skeleton));
  }
  return [
    ...(skeleton && isAcclaim ? [part('asf', skeleton.name, skeleton, parts.skeleton)] : []),
    ...captured,
    ...(skeleton && !capture && !isAcclaim && !isPoints ? [part('skel', skeleton.name, skeleton, parts.skeleton)] : []),
    ...skins.map((skin, i) => part('skin', skin.name, skin, parts.skins[i])),
    ...morphs.map((morph, i) => part('morph', morph.name, morph, parts.morphs[i])),
    ...animations,
    ...(poses ? [part('pose', name, { ...(skeleton && { skeleton }), morphs, poses }, parts.poses)] : []),
    ...(skeleton && sets ? [part('sets', stemBeside(skeleton, parts.skeleton), { skeleton, sets }, parts.sets)] : []),
    ...(skeleton && limbs
      ? [part('limbs', stemBeside(skeleton, parts.skeleton), { skeleton, limbs }, parts.limbs)]
      : []),
  ];
}

/** What files beside a skeleton are called: that of its file comes first, so that they find each other again. */
function stemBeside({ name }: Skeleton, mark: PartMark | undefined): string {
  const stem = mark?.file && stemOf(mark.file.source);
  return stem === undefined || name.toLowerCase().startsWith(stem.toLowerCase()) ? name : stem;
}

function part<K extends PartKind>(kind: K, name: string, content: PartContents[K], mark = UNMARKED): Part {
  const { id, revision, withoutMarkers, file } = mark;
  const own = isFrom(mark, kind, name) ? file?.source : undefined;
  // A member of the union, but TypeScript can't infer which one for a generic kind.
  const { source } = file ?? {};
  return {
    ...{ kind, id, revision, name, content },
    ...(withoutMarkers !== undefined && { withoutMarkers }),
    ...(own && { file: own }),
    ...(source && { readFrom: source }),
  } as Part;
}

/** Skeletons, poses, sets and limbs are named independently of their files; all others take the file's name. */
function isFrom(mark: PartMark | undefined, kind: PartKind, name: string): boolean {
  const { file } = mark ?? {};
  return file?.kind === kind && (isSkeletonKind(kind) || isNamedApart(kind) || file.holds === name);
}
