// SPDX-License-Identifier: MIT
// How labels are told apart in the sums that caps are drawn from. A sum is exact as long as it is a
// whole number that its channel can hold: each label has some bits of one of four channels for
// itself, in which the surfaces around a place are counted. Larger labels come first, so that the
// highest bit belongs to the smallest label. Where labels are too many the largest have bits, and
// the others share the last channel: a number tells them apart where they do not overlap.

const channels = 4;
const shared = 8192;  // labels that can share a channel

// `exact`: how many bits a channel holds, `room` those of them for sums on their way. Undefined
// where there are too many labels.
export function layOut(count, { exact, room }) {
  const bits = exact - room;
  if (count <= channels * bits) {
    const perChannel = Math.max(Math.ceil(count / channels), 1);
    return { own: channels, perChannel, bits: Math.floor(bits / perChannel) };
  }
  const isRoomy = 2 ** bits >= shared;
  return isRoomy && count <= (channels - 1) * bits + shared
    ? { own: channels - 1, perChannel: bits, bits: 1 } : undefined;
}

// What surfaces of a label add to the four channels; `sign` is -1 where they are inside out.
export function codeOf(index, { own, perChannel, bits }, sign) {
  const code = [0, 0, 0, 0];
  const channel = Math.floor(index / perChannel);
  if (channel < own) code[channel] = sign * 2 ** (bits * (index % perChannel));
  else code[channels - 1] = sign * (shared + index - own * perChannel);
  return code;
}

// Finds the labels in a sum, the smallest first: `visit(label)` is a function of the shader that
// returns whether it has seen enough; -1 stands for several that share a channel.
export const decoding = `
uniform int own, perChannel, bits;

bool visit(int label);

void decode(vec4 sum) {
  sum = floor(sum + 0.5);
  if (own < ${channels} && sum.a >= ${shared}.0) {
    float count = floor(sum.a / ${shared}.0);
    if (visit(count > 1.5 ? -1 : own * perChannel + int(sum.a - count * ${shared}.0))) return;
  }
  for (int channel = own - 1; channel >= 0; --channel) {
    float rest = sum[channel];
    for (int i = 0; i < 24 && rest >= 1.0; ++i) {
      int slot = ((floatBitsToInt(rest) >> 23) - 127) / bits;
      if (visit(channel * perChannel + min(slot, perChannel - 1))) return;
      rest = mod(rest, exp2(float(slot * bits)));
    }
  }
}`;
