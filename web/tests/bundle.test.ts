import { expect, test } from "vitest";
import { bundle, type Given } from "../src/bundle";

const given = (path: string, content: BlobPart = ""): Given => ({
  path,
  file: new Blob([content]),
});
const gltf = (document: object, path = "duck.gltf") => given(path, JSON.stringify(document));
const BYTES = new Uint8Array([0, 1, 254, 255]);

/** The document that is sent. */
async function sent(...files: Given[]) {
  const { name, body } = await bundle(files);
  return { name, document: JSON.parse(body as string) };
}

test("a .glb is sent as it is, whatever lies beside it", async () => {
  const duck = given("things/Duck.GLB", BYTES);
  expect(await bundle([given("notes.txt"), duck])).toEqual({ name: "Duck.GLB", body: duck.file });
});

test("what a .gltf refers to is put into it, all else stays", async () => {
  const { name, document } = await sent(
    gltf({
      asset: { version: "2.0" },
      buffers: [{ uri: "duck%20part.bin", byteLength: 4 }, { byteLength: 2 }],
      images: [{ uri: "skin.JPG" }, { bufferView: 0 }, { uri: "data:image/png;base64,AA==" }],
    }),
    given("duck part.bin", BYTES),
    given("skin.JPG", BYTES),
  );
  expect(name).toBe("duck.gltf");
  expect(document).toEqual({
    asset: { version: "2.0" },
    buffers: [
      { uri: "data:application/octet-stream;base64,AAH+/w==", byteLength: 4 },
      { byteLength: 2 },
    ],
    images: [
      { uri: "data:image/jpeg;base64,AAH+/w==" },
      { bufferView: 0 },
      { uri: "data:image/png;base64,AA==" },
    ],
  });
});

test("an image's own type stands above its file's ending", async () => {
  const { document } = await sent(
    gltf({ images: [{ uri: "a.img", mimeType: "image/webp" }] }),
    given("a.img", "x"),
  );
  expect(document.images[0].uri).toBe("data:image/webp;base64,eA==");
});

test("more bytes than a call has arguments come through", async () => {
  const large = new Uint8Array(300_001).map((_, at) => at);
  const { document } = await sent(gltf({ buffers: [{ uri: "a.bin" }] }), given("a.bin", large));
  const [, text] = document.buffers[0].uri.split(",");
  expect(Buffer.from(text, "base64").equals(Buffer.from(large))).toBe(true);
});

test("in a folder the path counts, among loose files the name", async () => {
  const model = { buffers: [{ uri: "./parts/a.bin" }] };
  const uri = async (...files: Given[]) => (await sent(...files)).document.buffers[0].uri;
  const right = given("room/parts/a.bin", "r");
  const wrong = given("room/a.bin", "w");
  expect(await uri(wrong, gltf(model, "room/room.gltf"), right)).toContain(btoa("r"));
  expect(await uri(gltf(model), given("a.bin", "l"))).toContain(btoa("l"));
});

test.each([
  [[], "There is no file in it: drop a .glb, or a .gltf with the files that it refers to."],
  [[given("a.png")], "There is no model in a.png: drop a .glb, or"],
  [[given("a.glb"), given("x/b.gltf")], "Drop one model at a time; these are a.glb and b.gltf."],
  [
    [gltf({ buffers: [{ uri: "b.bin" }], images: [{ uri: "c.png" }, { uri: "c.png" }] })],
    "duck.gltf: refers to b.bin and c.png, which were not dropped: drop all its files together.",
  ],
  [
    [gltf({ images: ["a", "b", "c", "d", "e"].map((uri) => ({ uri })) })],
    "duck.gltf: refers to a, b, c and 2 more, which were not dropped",
  ],
  [
    [gltf({ buffers: [{ uri: "https://example.org/a.bin" }] })],
    "refers to https://example.org/a.bin, which was not dropped",
  ],
])("%#: what is not there is said by name", async (files, sentence) => {
  await expect(bundle(files)).rejects.toThrow(sentence);
});

test("what is no model is left to the server, which says what is wrong with it", async () => {
  for (const text of ["", "{", "null", "[]", '{"buffers": 3, "images": [null, 4]}']) {
    expect(await bundle([given("a.gltf", text)])).toEqual({ name: "a.gltf", body: text });
  }
});

test("a file that is gone since is named", async () => {
  const file = { text: () => Promise.reject(new DOMException("gone")) } as unknown as Blob;
  const failure = bundle([{ path: "a.gltf", file }]);
  await expect(failure).rejects.toThrow("a.gltf: cannot be read; is it still there?");
});
