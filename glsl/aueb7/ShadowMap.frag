#version 330 core
// The shadow map: nothing to do, for the depth is written anyway. What SpotLight.frag discards casts a shadow, too.

void main(void)
{
}
