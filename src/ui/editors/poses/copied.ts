/** The pose that was copied on this page, until another is: by names, so that it goes onto other characters too. */
import type { Store } from '../../../edit/store.ts';
import type { PoseByNames } from '../../../model/pose-by-names.ts';
import { observable } from '../../kit/observable.ts';
import type { Workbench } from '../../state/workbench.ts';

export interface CopiedPose {
  readonly pose: PoseByNames;
  /** Of whom it is. */
  readonly from: string;
}

const copied = new WeakMap<Store, ReturnType<typeof observable<CopiedPose | undefined>>>();

/** What was copied; undefined until something is. */
export function copiedPose({ store }: Pick<Workbench, 'store'>) {
  let own = copied.get(store);
  if (!own) {
    own = observable<CopiedPose | undefined>(undefined);
    copied.set(store, own);
  }
  return own;
}
