/** The content of every example. */
import type { ChannelClip } from '../model/clip.ts';
import type { Morph } from '../model/morph.ts';
import type { Rig } from '../model/rig.ts';
import type { Display } from '../model/session.ts';
import type { Skeleton } from '../model/skeleton.ts';
import type { Skin } from '../model/skin.ts';

/** A character as models, before it is written. The rig names the files. */
export interface Sample {
  readonly id: string;
  readonly label: string;
  readonly description: string;
  readonly skeleton: Skeleton;
  readonly skin?: Skin;
  readonly morphs: readonly Morph[];
  readonly clip: ChannelClip;
  readonly rig: Rig;
  /** Parts of the display that the example switches on; absent: none. */
  readonly shows?: Pick<Partial<Display>, 'names' | 'bones' | 'axes' | 'followRoot'>;
  readonly textures: readonly { readonly name: string; readonly bytes: Uint8Array }[];
}
