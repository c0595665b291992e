/** `--pin JOINT[@x,y,z]=x,y,z[,weight]`: a point of a joint, by default its tip or origin, and where it shall be. */
import type { IkReach } from '../evaluate/ik/limb.ts';
import type { IkPin } from '../evaluate/ik/pins.ts';
import type { Vec3 } from '../math/vec3.ts';
import { cutText } from '../model/names/cut-text.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { type Kind, numbers, readValue } from './options/kinds.ts';
import { UsageError } from './usage-error.ts';

/** A parsed `--pin`, before the skeleton is known. */
export interface AskedPin {
  readonly text: string;
  readonly target: Vec3;
  readonly weight: number;
  /** The part before the `=`: a joint, optionally with a point. */
  readonly what: string;
}

const NUMBERS = numbers('x,y,z');

export const PIN: Kind<AskedPin> = {
  placeholder: 'JOINT[@x,y,z]=x,y,z[,weight]',
  what: 'JOINT=x,y,z, a joint and its target',
  read: readPin,
};

/** @throws UsageError if it isn't `JOINT[@x,y,z]=x,y,z[,weight]` */
function readPin(text: string): AskedPin {
  // The last one: a name may contain `=`, numbers don't.
  const equals = text.lastIndexOf('=');
  if (equals < 0) throw new UsageError(`--pin takes JOINT=x,y,z; "${cutText(text)}" has no "=".`);
  const values = readValue(NUMBERS, text.slice(equals + 1), '--pin');
  if (values.length !== 3 && values.length !== 4) {
    throw new UsageError(
      `--pin takes 3 numbers and an optional weight after "="; "${cutText(text)}" has ${values.length}.`,
    );
  }
  const [x, y, z, weight = 1] = values;
  if (!(weight > 0)) throw new UsageError(`--pin takes weights greater than 0; "${cutText(text)}" has ${weight}.`);
  return { text, target: [x, y, z], weight, what: text.slice(0, equals) };
}

/** @throws UsageError if the skeleton has no such joint */
export function resolvePin(skeleton: Skeleton, { what, target, weight, text }: AskedPin): IkPin {
  const at = what.lastIndexOf('@');
  const hasPoint = at >= 0 && !skeleton.joints.some(({ name }) => name === what);
  const joint = jointCalled(skeleton, hasPoint ? what.slice(0, at) : what);
  const point = hasPoint ? readValue(NUMBERS, what.slice(at + 1), '--pin') : [0, skeleton.joints[joint].length ?? 0, 0];
  if (point.length !== 3)
    throw new UsageError(`--pin takes a point as JOINT@x,y,z; "${text}" has ${point.length} numbers there.`);
  const [x, y, z] = point;
  return { joint, point: [x, y, z], target, weight };
}

/** `--reach`: `limb`, `body`, or `chain:JOINT`, the joint up to which a chain goes. */
export const REACH: Kind<string> = {
  placeholder: 'limb|body|chain:JOINT',
  what: 'limb, body or chain:JOINT',
  read: (text, misfit) => (text === 'limb' || text === 'body' || text.startsWith(CHAIN) ? text : misfit()),
};
const CHAIN = 'chain:';

/** @throws UsageError if the skeleton has no such joint */
export function resolveReach(skeleton: Skeleton, text: string): IkReach {
  if (text.startsWith(CHAIN)) return { top: jointCalled(skeleton, text.slice(CHAIN.length)) };
  return text === 'body' ? 'body' : 'limb';
}

/** `#index`, or a name that is unique in the skeleton. */
function jointCalled({ name: skeleton, joints }: Skeleton, called: string): number {
  if (/^#\d+$/.test(called)) {
    const index = Number(called.slice(1));
    if (index < joints.length) return index;
    throw new UsageError(`There is no joint ${called} in "${skeleton}", only #0 to #${joints.length - 1}.`);
  }
  const fits = joints.flatMap(({ name }, j) => (name === called ? [j] : []));
  if (fits.length === 1 && called !== '') return fits[0];
  if (fits.length > 1 && called !== '')
    throw new UsageError(`"${called}" is the name of ${fits.length} joints: use #${fits.join(' or #')}.`);
  const names = joints.map(({ name }, j) => name || `#${j}`);
  const some = names.length > 12 ? `${names.slice(0, 12).join(', ')} … #${names.length - 1}` : names.join(', ');
  throw new UsageError(`There is no joint "${called}" in "${skeleton}". There are: ${some}.`);
}
