// The box room drawn by three.js from our own scene file and mesh files: same triangles, lights and
// camera. `measure` times whole frames, each forced to its end by reading one pixel back.
import * as THREE from 'three';

const SPHERE = 'icosphere-5';
// Bytes before a mesh's positions: vertices, indices and flags, which these shapes have none of.
const HEADER = 12;
const meshKey = (thing) => ({
  sphere: SPHERE,
  cone: `cone-${thing.stacks}x${thing.sectors}`,
}[thing.shape] ?? thing.shape);

const color = (triple) => new THREE.Color().setRGB(...triple, THREE.LinearSRGBColorSpace);

async function geometry(key) {
  const data = await (await fetch(`/data/meshes/${key}.bin`)).arrayBuffer();
  const [vertices, indices] = new Uint32Array(data, 0, HEADER / 4);
  const result = new THREE.BufferGeometry();
  result.setAttribute('position', new THREE.BufferAttribute(new Float32Array(data, HEADER, vertices * 3), 3));
  result.setAttribute('normal', new THREE.BufferAttribute(
    new Float32Array(data, HEADER + vertices * 12, vertices * 3), 3));
  result.setIndex(new THREE.BufferAttribute(new Uint32Array(data, HEADER + vertices * 48, indices), 1));
  return result;
}

const MATERIALS = {
  MeshPhongMaterial: (m) => new THREE.MeshPhongMaterial({
    color: color(m.base_color),
    shininess: Math.min(2 / Math.max(m.roughness, 0.03) ** 4 - 2, 1000),
  }),
  MeshStandardMaterial: (m) => new THREE.MeshStandardMaterial({
    color: color(m.base_color), metalness: m.metalness, roughness: m.roughness,
  }),
};

const LIGHTS = {
  point: (l) => new THREE.PointLight(color(l.color), l.intensity),
  directional: (l) => new THREE.DirectionalLight(color(l.color), l.intensity),
  spot: (l) => new THREE.SpotLight(color(l.color), l.intensity, 0, l.outer * Math.PI / 180,
    1 - l.inner / l.outer),
};

function light(description) {
  const made = LIGHTS[description.type](description);
  const direction = new THREE.Vector3(...(description.direction ?? [0, -1, 0]));
  made.position.set(...(description.position ?? direction.clone().negate().toArray()));
  if (made.target) made.target.position.copy(made.position).add(direction);
  return made;
}

async function room(material) {
  const described = await (await fetch('/data/scenes/box-room.json')).json();
  const scene = new THREE.Scene();
  const radians = (degrees) => degrees * Math.PI / 180;
  for (const thing of Object.values(described.objects)) {
    const mesh = new THREE.Mesh(await geometry(meshKey(thing)),
      MATERIALS[material](described.materials[thing.material]));
    mesh.position.set(...thing.position);
    mesh.rotation.set(...thing.rotation.map(radians), 'ZYX');
    mesh.scale.set(...thing.scale);
    scene.add(mesh);
  }
  for (const made of Object.values(described.lights).map(light)) {
    scene.add(made);
    if (made.target) scene.add(made.target);
  }
  scene.add(new THREE.AmbientLight(0xffffff, described.settings.ambient_level));
  const camera = new THREE.PerspectiveCamera(described.camera.fov, 1, 0.02, 30);
  camera.position.set(...described.camera.eye);
  camera.lookAt(...described.camera.target);
  return { scene, camera };
}

const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
renderer.toneMapping = THREE.ReinhardToneMapping;
document.body.append(renderer.domElement);
const rooms = {};
window.ready = (async () => {
  for (const name of Object.keys(MATERIALS)) rooms[name] = await room(name);
})();

window.measure = (material, [width, height], frames) => {
  const gl = renderer.getContext();
  const pixel = new Uint8Array(4);
  const { scene, camera } = rooms[material];
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  renderer.setPixelRatio(1);
  renderer.setSize(width, height);
  const milliseconds = [];
  for (let frame = 0; frame < frames + 3; ++frame) {
    const start = performance.now();
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    if (frame >= 3) milliseconds.push(performance.now() - start);
  }
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  return { milliseconds, renderer: gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER) };
};
