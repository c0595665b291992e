/** Writes `.limbs.json`, a line for each limb and goal; what is as when left out is left out. */
import type { LimbByName } from '../../model/limbs.ts';
import type { LimbsFile } from '../../model/takes/limbs-file.ts';
import type { Goal } from '../../model/takes/take.ts';
import { curveValue } from '../json/curve.ts';
import { flattenedValue } from '../json/flattened.ts';
import { writeJson } from '../json/write.ts';
import type { WriteResult } from '../reader.ts';

/** `fileName` appears in diagnostics. */
export function writeLimbs({ limbs, goals, base, flattened, others }: LimbsFile, fileName = ''): WriteResult {
  return writeJson(
    {
      limbs: limbs?.map(limbRow),
      base,
      flattened: flattenedValue(flattened),
      goals: goals?.map(goalRow),
      ...others,
    },
    fileName,
  );
}

function limbRow({ name, joints, tip, orient, bend, others }: LimbByName) {
  return {
    ...{ name, joints },
    ...(tip.some((part) => part !== 0) && { tip }),
    ...(orient && { orient }),
    ...(bend && { bend: { dof: bend.dof, sign: bend.sign, ...bend.others } }),
    ...others,
  };
}

function goalRow({ limb, space, channels, ofChannels, others }: Goal) {
  const curves = Object.entries(channels).map(([name, curve]) => [name, curveValue(curve)]);
  return { limb, space, channels: { ...Object.fromEntries(curves), ...ofChannels }, ...others };
}
