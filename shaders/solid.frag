#version 330 core
// The inside of a large shape: whole pixels of one colour.
flat in vec4 fill;
out vec4 color;

void main() { color = fill; }
