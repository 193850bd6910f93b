// Meshes written for tests: a cube of 10 mm as OBJ and as 3MF.

const corners = [0, 1].flatMap((z) => [[0, 0], [10, 0], [10, 10], [0, 10]].map(([x, y]) => [x, y, 10 * z]));
const quads = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]; // seen from outside, counterclockwise
const triangles = quads.flatMap(([a, b, c, d]) => [[a, b, c], [a, c, d]]);

export function obj_cube() {
  return Buffer.from([...corners.map((p) => `v ${p.join(" ")}`), ...triangles.map((t) => `f ${t.map((i) => i + 1).join(" ")}`)].join("\n") + "\n");
}

export function cube_3mf() {
  const points = corners.map(([x, y, z]) => `<vertex x="${x}" y="${y}" z="${z}"/>`).join(""), faces = triangles.map(([a, b, c]) => `<triangle v1="${a}" v2="${b}" v3="${c}"/>`).join("");
  return stored_zip({
    "[Content_Types].xml": `<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>`,
    "_rels/.rels": `<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>`,
    "3D/3dmodel.model": `<?xml version="1.0"?><model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model"><mesh><vertices>${points}</vertices><triangles>${faces}</triangles></mesh></object></resources><build><item objectid="1"/></build></model>`,
  });
}

function crc32(bytes) {
  let crc = ~0;
  for (const b of bytes) { crc ^= b; for (let k = 0; k < 8; k++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0); }
  return ~crc >>> 0;
}

/** A ZIP archive of texts by name, not compressed. */
function stored_zip(files) {
  const local = [], central = [];
  let at = 0;
  for (const [name, text] of Object.entries(files)) {
    const data = Buffer.from(text), title = Buffer.from(name), common = Buffer.alloc(26);
    common.writeUInt16LE(20, 0); // version; flags, method, time and date are 0
    common.writeUInt16LE(0x21, 8); // 1980-01-01
    common.writeUInt32LE(crc32(data), 10);
    common.writeUInt32LE(data.length, 14);
    common.writeUInt32LE(data.length, 18);
    common.writeUInt16LE(title.length, 22);
    const rest = Buffer.alloc(14);
    rest.writeUInt32LE(at, 10);
    central.push(Buffer.from("PK\x01\x02\x14\x00", "latin1"), common, rest, title);
    local.push(Buffer.from("PK\x03\x04", "latin1"), common, title, data);
    at += 30 + title.length + data.length;
  }
  const count = Object.keys(files).length, directory = Buffer.concat(central), end = Buffer.alloc(22);
  end.write("PK\x05\x06", "latin1");
  end.writeUInt16LE(count, 8);
  end.writeUInt16LE(count, 10);
  end.writeUInt32LE(directory.length, 12);
  end.writeUInt32LE(at, 16);
  return Buffer.concat([...local, directory, end]);
}
