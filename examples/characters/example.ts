/** The content of every example. */

import type { Morph } from '../../src/model/morph.ts';
import type { Rig } from '../../src/model/rig.ts';
import type { Display } from '../../src/model/session.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import type { Skin } from '../../src/model/skin.ts';
import type { Take } from '../../src/model/takes/take.ts';

/** A character as models, before it is written. The rig names the files. */
export interface Sample {
  readonly id: string;
  readonly label: string;
  readonly description: string;
  readonly skeleton: Skeleton;
  readonly skin?: Skin;
  readonly morphs: readonly Morph[];
  readonly take: Take;
  readonly rig: Rig;
  /** Parts of the display that the example switches on; absent: none. */
  readonly shows?: Pick<Partial<Display>, 'names' | 'bones' | 'axes' | 'followRoot'>;
  readonly textures: readonly { readonly name: string; readonly bytes: Uint8Array }[];
}
