/** Joints of layers that a character lacks. */
import { type Diagnostic, withoutPlace } from '../diagnostic.ts';
import type { Character } from '../document.ts';
import { sameName } from '../files.ts';
import { jointReferred } from '../skeleton/joint-reference.ts';
import { LAYERS_EXTENSION } from './layers-file.ts';
import type { Take } from './take.ts';

/** Joints that layers of a take touch and the skeleton lacks, with their places in the JSON. */
export function unknownJoints({ name, layers }: Take, { skeleton, sources }: Character): readonly Diagnostic[] {
  if (!skeleton) return [];
  const indexOf = jointReferred(skeleton.joints);
  const json = `${name}.${LAYERS_EXTENSION}`;
  const file = sources.find((source) => sameName(source.name, json))?.path ?? json;
  return (layers?.list ?? []).flatMap(({ joints = [] }, i) =>
    joints.flatMap((joint, j) => {
      if (indexOf(joint) !== undefined) return [];
      const message = `layers[${i}].joints[${j}]: ${skeleton.name} has no joint "${joint}".`;
      return [withoutPlace('warning', 'layer-joint-unknown', message, file, 'left out')];
    }),
  );
}
