/** Contents of an FBX file that a character can't have. */
import type { FbxDocument } from './document.ts';
import type { FbxNode } from './nodes.ts';

const COUNTED: readonly (readonly [kind: string, type: RegExp, one: string, many: string])[] = [
  ['Constraint', /./, 'constraint', 'constraints'],
  ['NodeAttribute', /^Camera/, 'camera', 'cameras'],
  ['NodeAttribute', /^Light$/, 'light', 'lights'],
  ['Deformer', /Cache/, 'geometry cache', 'geometry caches'],
  ['Audio', /./, 'sound', 'sounds'],
];

/** For one message: "2 cameras". */
export function lostOf(document: FbxDocument, nodes: readonly FbxNode[]): string[] {
  const lost = COUNTED.flatMap(([kind, type, one, many]) => {
    const count = document.objects.filter((object) => kind === object.kind && type.test(object.type)).length;
    return count === 0 ? [] : [`${count} ${count === 1 ? one : many}`];
  });
  const unplaced = document.objects.filter(({ kind }) => kind === 'Model').length - nodes.length;
  if (unplaced > 0)
    lost.push(`${unplaced} ${unplaced === 1 ? 'model' : 'models'} outside the scene or nested too deeply`);
  const isHidden = nodes.some(({ object }) => object.properties.number('Visibility') === 0);
  const isHiding = document.objects.some(
    ({ id, kind }) =>
      kind === 'AnimationCurve' && document.ownersOf(id).some(({ property }) => property === 'd|Visibility'),
  );
  return isHidden || isHiding ? [...lost, 'visibility'] : lost;
}
