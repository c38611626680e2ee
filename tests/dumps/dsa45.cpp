// A shadow map in OpenGL 4.5 with direct state access: GLUT, one matrix a pass, the bias matrix in the program, a sampler
// object, immutable textures, debug groups. For the lab csci3260. Right as it stands; each MISTAKE_… makes one of the
// classic mistakes.
#define GL_GLEXT_PROTOTYPES
#include <GL/freeglut.h>
#include <GL/glext.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

static const int MAP = 400, WIDTH = 320, HEIGHT = 200;
static GLuint map_texture, map_framebuffer, map_sampler, sea_texture, shadow_program, basic_program, meshes[2];
static int frames = 0;

typedef float Mat[16];

static void product(const Mat a, const Mat b, Mat out) {
    Mat c;
    for (int i = 0; i < 16; i++) {
        c[i] = 0;
        for (int k = 0; k < 4; k++) c[i] += a[4 * k + i % 4] * b[i / 4 * 4 + k];
    }
    std::memcpy(out, c, sizeof c);
}

static const char *shadow_vert =
    "#version 450 core\n"
    "layout(location = 0) in vec3 position; layout(location = 0) uniform mat4 depthMVP;\n"
    "out gl_PerVertex { vec4 gl_Position; };\n"
    "void main() { gl_Position = depthMVP * vec4(position, 1); }\n";
static const char *shadow_frag = "#version 450 core\nvoid main() {}\n";
static const char *basic_vert =
    "#version 450 core\n"
    "layout(location = 0) in vec3 position; layout(location = 0) uniform mat4 MVP;\n"
    "layout(location = 4) uniform mat4 DepthBiasMVP; out vec4 ShadowCoord;\n"
    "void main() { gl_Position = MVP * vec4(position, 1); ShadowCoord = DepthBiasMVP * vec4(position, 1); }\n";
static const char *basic_frag =
    "#version 450 core\n"
    "in vec4 ShadowCoord; out vec4 color; layout(location = 8) uniform float visible;\n"
#ifdef MISTAKE_same_texture_unit
    "layout(binding = 0) uniform sampler2D objTexture; layout(binding = 0) uniform sampler2DShadow shadowMap;\n"
#else
    "layout(binding = 0) uniform sampler2D objTexture; layout(binding = 1) uniform sampler2DShadow shadowMap;\n"
#endif
    "void main() {\n"
    "    float visibility = mix(0.4, visible, texture(shadowMap, ShadowCoord.xyz));\n"
    "    color = visibility * texture(objTexture, ShadowCoord.xy);\n"
    "}\n";

static GLuint program(const char *vert, const char *frag) {
    GLuint made = glCreateProgram();
    const char *texts[2] = {vert, frag};
    for (int i = 0; i < 2; i++) {
        GLuint shader = glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        glShaderSource(shader, 1, &texts[i], NULL);
        glCompileShader(shader);
        glAttachShader(made, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(made);
    GLint linked;
    glGetProgramiv(made, GL_LINK_STATUS, &linked);
    if (!linked) puts("not linked");
    return made;
}

static void init() {
    glCreateTextures(GL_TEXTURE_2D, 1, &map_texture);
    glTextureStorage2D(map_texture, 1, GL_DEPTH_COMPONENT32F, MAP, MAP);
    glCreateSamplers(1, &map_sampler);
    glSamplerParameteri(map_sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
#ifndef MISTAKE_compare_mode
    glSamplerParameteri(map_sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
#endif
#ifndef MISTAKE_repeat_outside
    glSamplerParameteri(map_sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(map_sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
#endif
    glCreateFramebuffers(1, &map_framebuffer);
    glNamedFramebufferTexture(map_framebuffer, GL_DEPTH_ATTACHMENT, map_texture, 0);
#ifndef MISTAKE_no_draw_buffer_none
    glNamedFramebufferDrawBuffer(map_framebuffer, GL_NONE);
    glNamedFramebufferReadBuffer(map_framebuffer, GL_NONE);
#endif
#ifndef MISTAKE_unchecked
    if (glCheckNamedFramebufferStatus(map_framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) puts("incomplete");
#endif

    unsigned char blue[4] = {90, 140, 220, 255};
    glCreateTextures(GL_TEXTURE_2D, 1, &sea_texture);
    glTextureStorage2D(sea_texture, 1, GL_RGBA8, 1, 1);
    glTextureSubImage2D(sea_texture, 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, blue);

    float vertices[2][12] = {{-9, -1, -9, 9, -1, -9, -9, -1, 9, 9, -1, 9}, {-2, 1, 0, 2, 1, 0, -1, 2, 1, 1, 2, 1}};
    for (int i = 0; i < 2; i++) {
        GLuint buffer;
        glCreateBuffers(1, &buffer);
        glNamedBufferStorage(buffer, sizeof vertices[i], vertices[i], 0);
        glCreateVertexArrays(1, &meshes[i]);
        glVertexArrayVertexBuffer(meshes[i], 0, buffer, 0, 12);
        glEnableVertexArrayAttrib(meshes[i], 0);
        glVertexArrayAttribFormat(meshes[i], 0, 3, GL_FLOAT, GL_FALSE, 0);
    }
    shadow_program = program(shadow_vert, shadow_frag);
    basic_program = program(basic_vert, basic_frag);
    glProgramUniform1f(basic_program, 8, 1);
    glEnable(GL_DEPTH_TEST);
}

static void display() {
    // The light's camera looks down along y, tilted a little; 20 units wide, 20 deep.
    float c = std::cos(1.1f), s = std::sin(1.1f);
    Mat light = {.1f, 0, 0, 0, 0, .1f * c, -.1f * s, 0, 0, .1f * s, .1f * c, 0, 0, 0, 0, 1};
    Mat eye = {.2f, 0, 0, 0, 0, .25f, -.02f, -.1f, 0, -.05f, -.1f, -.3f, 0, 0, 2, 5};
#if defined(MISTAKE_bias_matrix_swapped)
    Mat bias = {.5f, 0, 0, 0, 0, .5f, 0, 0, 0, 0, .5f, 0, .25f, .25f, .25f, 1};
#elif defined(MISTAKE_bias_matrix_missing)
    Mat bias = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
#else
    Mat bias = {.5f, 0, 0, 0, 0, .5f, 0, 0, 0, 0, .5f, 0, .5f, .5f, .5f, 1};
#endif
    Mat biased, models[2] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    models[1][12] = .5f * frames;
    product(bias, light, biased);
#ifdef MISTAKE_bias_matrix_twice
    product(bias, biased, biased);
#endif

    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 1, -1, "shadow map");
    glBindFramebuffer(GL_FRAMEBUFFER, map_framebuffer);
    glUseProgram(shadow_program);
#ifdef MISTAKE_viewport_not_set
    glViewport(0, 0, MAP / 2, MAP / 2);
#else
    glViewport(0, 0, MAP, MAP);
#endif
    float one = 1;
#if !defined(MISTAKE_map_not_cleared) && !defined(MISTAKE_cleared_late)
    glClearNamedFramebufferfv(map_framebuffer, GL_DEPTH, 0, &one);
#endif
    for (int i = 0; i < 2; i++) {
        Mat mvp;
        product(light, models[i], mvp);
        glUniformMatrix4fv(0, 1, GL_FALSE, mvp);
        glBindVertexArray(meshes[i]);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
#ifdef MISTAKE_cleared_late
    glClearNamedFramebufferfv(map_framebuffer, GL_DEPTH, 0, &one);
#endif
    glPopDebugGroup();

#ifndef MISTAKE_framebuffer_not_restored
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
#endif
#ifndef MISTAKE_viewport_not_restored
    glViewport(0, 0, WIDTH, HEIGHT);
#endif
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(basic_program);
    glBindTextureUnit(0, sea_texture);
#ifndef MISTAKE_map_not_bound
    glBindTextureUnit(1, map_texture);
#endif
    glBindSampler(1, map_sampler);
    for (int i = 0; i < 2; i++) {
        Mat mvp, depth;
        product(eye, models[i], mvp);
        product(biased, models[i], depth);
        glProgramUniformMatrix4fv(basic_program, 0, 1, GL_FALSE, mvp);
#ifdef MISTAKE_row_major
        glProgramUniformMatrix4fv(basic_program, 4, 1, GL_TRUE, depth);
#else
        glProgramUniformMatrix4fv(basic_program, 4, 1, GL_FALSE, depth);
#endif
        glBindVertexArray(meshes[i]);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    if (glGetError() != GL_NO_ERROR) puts("error");
    glutSwapBuffers();
    if (++frames == 2) exit(0);
    glutPostRedisplay();
}

int main(int argc, char **argv) {
    glutInit(&argc, argv);
    glutInitContextVersion(4, 5);
    glutInitContextProfile(GLUT_CORE_PROFILE);
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH);
    glutInitWindowSize(WIDTH, HEIGHT);
    glutCreateWindow("shadows");
    init();
    glutDisplayFunc(display);
    glutMainLoop();
}
