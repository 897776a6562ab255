"""What a dog's camera sees, saved as a picture.
      btr serve   and then   python3 camera_picture.py [ADDRESS [FILE.png]]
"""
import struct
import sys
import zlib

import uchilsim

address, file = (sys.argv[1:] + ["127.0.0.1:50051", "picture.png"][len(sys.argv) - 1:])[:2]


def png(rgb):
    """An array (height, width, 3) of uint8 as the bytes of a PNG file."""
    height, width, _ = rgb.shape
    rows = b"".join(b"\0" + row.tobytes() for row in rgb)

    def part(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + part(b"IHDR", head) + part(b"IDAT", zlib.compress(rows)) + part(b"IEND", b"")


with uchilsim.Client(address) as client, client.open("games/dog.json") as world:
    world.add(ball={"name": "ball", "position_m": [0.6, 0.05, 0.0425]})
    world.step(25)
    with open(file, "wb") as out:
        out.write(png(world.picture("dog")))
    print(file)
