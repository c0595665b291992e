/** What a comparison with another program's numbers draws over the scene. None of it is picked. */
import { Group } from 'three';
import type { Overlay } from '../overlay.ts';
import type { StageTheme } from '../theme.ts';
import { type ComparedJoints, type ComparedSide, ComparedSkeleton, type JointAt } from './compared-skeleton.ts';
import { ComparedSkin, type ComparedVertices } from './compared-skin.ts';

/** Where the character is in the next frame; undefined if it isn't shown. The arrays are read at once. */
export interface ComparedPose {
  /** 16 numbers per joint, in the character's own space. */
  readonly world: Float64Array;
  /** 16 numbers per placement. */
  readonly placements: Float64Array;
}

export interface ComparedDrawing {
  readonly placementCount: number;
  readonly side: ComparedSide;
  readonly joints?: ComparedJoints;
  readonly vertices?: ComparedVertices;
}

export class CompareOverlay implements Overlay {
  readonly object = new Group();
  private readonly skeleton = new ComparedSkeleton();
  private readonly skin = new ComparedSkin();

  /** @param pose called before each frame */
  constructor(private readonly pose: () => ComparedPose | undefined) {
    this.object.add(this.skin.object, this.skeleton.object);
  }

  /** @param drawing undefined: nothing is drawn */
  show(drawing: ComparedDrawing | undefined): void {
    const { side = 'both', placementCount = 0 } = drawing ?? {};
    this.skeleton.show(drawing?.joints, side, placementCount);
    this.skin.show(drawing?.vertices, side, placementCount);
  }

  /** Lights up a joint of the character. */
  hover(joint: JointAt | undefined): void {
    this.skeleton.hover(joint);
  }

  update(): void {
    const pose = this.pose();
    this.object.visible = pose !== undefined;
    if (!pose) return;
    this.skeleton.fill(pose.world, pose.placements);
    this.skin.fill(pose.placements);
  }

  setTheme(theme: StageTheme): void {
    this.skeleton.setTheme(theme);
    this.skin.setTheme(theme);
  }

  dispose(): void {
    this.skeleton.dispose();
    this.skin.dispose();
  }
}
