/** The lights, the shadow and the ground that the page has, in plain three.js. */
import {
  Bone,
  Box3,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  NeutralToneMapping,
  PerspectiveCamera,
  PlaneGeometry,
  Scene,
  ShadowMaterial,
  Sphere,
  Vector3,
  WebGLRenderer,
} from 'three';
import type { PeerView } from './scene.ts';

const SHADOW_MAP = 2048;
/** Metres of a body around its joints. */
const FLESH = 0.3;
const TOWARDS_CAMERA = new Vector3(0.45, 0.3, 1).normalize();
const TOWARDS_LIGHT = new Vector3(-0.24, 1, 0.72).normalize();

export class PeerStage {
  readonly content = new Group();
  private readonly renderer = new WebGLRenderer({
    antialias: true,
    stencil: false,
    powerPreference: 'high-performance',
  });
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(35, 1, 0.1, 1000);
  private readonly key = new DirectionalLight('#fff0de', 2);
  /** A joint that goes where everything goes, and where it began. */
  private leader: Bone | undefined;
  private readonly start = new Vector3();
  private readonly place = new Vector3();

  constructor(
    { width, height }: PeerView['size'],
    private readonly shadow: boolean,
  ) {
    const { renderer, scene, key, content, camera } = this;
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    renderer.toneMapping = NeutralToneMapping;
    renderer.shadowMap.enabled = shadow;
    document.body.append(renderer.domElement);
    scene.background = new Color('#202428');
    key.castShadow = shadow;
    key.shadow.mapSize.set(SHADOW_MAP, SHADOW_MAP);
    const rim = new DirectionalLight('#b9d2ff', 2.4);
    const fill = new DirectionalLight('#fff4e8', 0.95);
    rim.position.set(0.62, 0.5, -0.78);
    fill.position.set(0.45, 0.25, 1);
    scene.add(content, key, key.target, rim, fill, new HemisphereLight('#eaf0ff', '#cfc6bb', 1.5));
  }

  /** Everything that was added is seen, casts a shadow if there is one, and stands on a ground that gets it. */
  frameAll(): void {
    const { content, camera, key, scene, shadow, place } = this;
    const box = new Box3();
    content.updateMatrixWorld();
    content.traverse((object) => {
      if (!(object instanceof Bone)) return;
      this.leader ??= object;
      box.expandByPoint(place.setFromMatrixPosition(object.matrixWorld));
    });
    if (!this.leader) return;
    this.start.setFromMatrixPosition(this.leader.matrixWorld);
    const { center, radius } = box.expandByScalar(FLESH).getBoundingSphere(new Sphere());
    camera.position
      .copy(TOWARDS_CAMERA)
      .multiplyScalar(radius / Math.sin((camera.fov * Math.PI) / 360))
      .add(center);
    camera.lookAt(center);
    content.traverse((object) => {
      // The page's characters cast shadows on the ground and get none.
      object.castShadow = shadow && object instanceof Mesh;
      // three.js tells by the pose of the file whether a mesh is in view; all of them always are.
      object.frustumCulled = false;
    });
    if (!shadow) return;
    key.position
      .copy(TOWARDS_LIGHT)
      .multiplyScalar(2 * radius)
      .add(center);
    key.target.position.copy(center);
    Object.assign(key.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, far: 4 * radius });
    key.shadow.camera.updateProjectionMatrix();
    const ground = new Mesh(new PlaneGeometry(8 * radius, 8 * radius), new ShadowMaterial({ opacity: 0.4 }));
    ground.rotation.x = -Math.PI / 2;
    ground.receiveShadow = true;
    scene.add(ground);
  }

  /** Who walks stays in view, as on the page, whose camera follows. */
  draw(): void {
    const { content, leader, place, start } = this;
    if (leader) {
      const { x, z } = place.setFromMatrixPosition(leader.matrixWorld).sub(start);
      content.position.x -= x;
      content.position.z -= z;
    }
    this.renderer.render(this.scene, this.camera);
  }
}
