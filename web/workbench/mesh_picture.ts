// A mesh in space with its surfaces, to be chosen by a click.

import { AmbientLight, Box3, BufferAttribute, BufferGeometry, DirectionalLight, DoubleSide, Mesh, MeshStandardMaterial, PerspectiveCamera, Raycaster, Scene, Sphere, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { h } from "../src/dom";
import { palette } from "../src/theme";
import { texts } from "./texts";

interface Triangles {
  corners: number[];
  triangles: number[];
}

export interface MeshScene {
  surfaces: (Triangles & { name: string })[];
  rest: Triangles;
}

export class MeshPicture {
  readonly element = h("div", { class: "mesh-space", role: "img", tabindex: 0, "aria-label": texts.mesh.picture });
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(30, 1, 0.01, 100);
  private readonly patches = new Map<string, Mesh>();
  private readonly whole: Mesh[] = [];
  private renderer: WebGLRenderer | null = null;
  private chosen: ReadonlySet<string> = new Set();

  constructor(
    private readonly mesh: MeshScene,
    private readonly pick: (name: string) => void,
  ) {
    let down: [number, number] | null = null;
    this.element.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
    this.element.addEventListener("pointerup", (event) => {
      const is = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4;
      down = null;
      const name = is ? this.surfaceAt(event.clientX, event.clientY) : null;
      if (name) this.pick(name);
    });
  }

  /** Once it has its place on the page. */
  begin(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    try {
      this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      return this.element.replaceChildren(h("p", { class: "note" }, texts.mesh.noPicture));
    }
    const colours = palette();
    const add = (part: Triangles, colour: string) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(Float32Array.from(part.corners), 3));
      geometry.setIndex(part.triangles);
      const flat = geometry.toNonIndexed();
      flat.computeVertexNormals();
      const made = new Mesh(flat, new MeshStandardMaterial({ color: colour, roughness: 0.6, side: DoubleSide }));
      this.scene.add(made);
      this.whole.push(made);
      return made;
    };
    add(this.mesh.rest, colours.faint);
    this.mesh.surfaces.forEach((surface, i) => {
      const patch = add(surface, colours.series[i % colours.series.length]!);
      patch.userData["name"] = surface.name;
      patch.userData["colour"] = colours.series[i % colours.series.length];
      this.patches.set(surface.name, patch);
    });
    this.scene.add(new AmbientLight(0xffffff, 1.2));
    const light = new DirectionalLight(0xffffff, 2.2);
    light.position.set(0.6, 1, 0.8);
    this.camera.add(light);
    this.scene.add(this.camera);
    this.renderer.setPixelRatio(devicePixelRatio || 1);
    this.renderer.setSize(width, height);
    this.element.append(this.renderer.domElement);
    const box = new Box3();
    for (const part of this.whole) box.expandByObject(part);
    const { center, radius } = box.getBoundingSphere(new Sphere());
    const distance = (1.05 * radius) / Math.sin((0.5 * this.camera.fov * Math.PI) / 180) / Math.min(1, width / height);
    this.camera.aspect = width / height;
    [this.camera.near, this.camera.far] = [0.01 * distance, 20 * distance];
    this.camera.position.copy(center).addScaledVector(new Vector3(0.45, 0.35, 1).normalize(), distance);
    this.camera.updateProjectionMatrix();
    const controls = new OrbitControls(this.camera, this.renderer.domElement);
    controls.target.copy(center);
    controls.addEventListener("change", () => this.render());
    controls.update();
    this.element.addEventListener("keydown", (event) => {
      const turns: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      const turn = turns[event.key];
      if (!turn) return;
      event.preventDefault();
      const from = this.camera.position.clone().sub(center);
      const side = new Vector3().crossVectors(this.camera.up, from).normalize();
      from.applyAxisAngle(this.camera.up, (turn[0] * Math.PI) / 24);
      const tilted = from.clone().applyAxisAngle(side, (turn[1] * Math.PI) / 24);
      if (Math.abs(tilted.clone().normalize().dot(this.camera.up)) < 0.99) from.copy(tilted);
      this.camera.position.copy(center).add(from);
      controls.update();
      this.render();
    });
    this.choose(this.chosen);
  }

  choose(names: ReadonlySet<string>): void {
    this.chosen = names;
    for (const [name, patch] of this.patches) {
      const paint = patch.material as MeshStandardMaterial;
      paint.color.set(names.has(name) ? "#e08a00" : (patch.userData["colour"] as string));
      paint.emissive.set(names.has(name) ? "#a85f00" : "#000000");
    }
    this.render();
  }

  private surfaceAt(x: number, y: number): string | null {
    const box = this.element.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height), this.camera);
    const hit = ray.intersectObjects(this.whole, false)[0];
    return (hit?.object.userData["name"] as string | undefined) ?? null;
  }

  private render(): void {
    this.renderer?.render(this.scene, this.camera);
  }

  end(): void {
    for (const part of this.whole) part.geometry.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
  }
}
