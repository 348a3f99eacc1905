// Relative luminance of linear Rec. 709 primaries, in the unit of the colour.
// Y = 0.2126 R + 0.7152 G + 0.0722 B. ITU-R BT.709-6, item 3.2.
float luminance(vec3 color) {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}
