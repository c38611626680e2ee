// A shadow map in OpenGL 3.3 core: EGL, matrices of one's own, separate projection, view and model matrices, the bias
// matrix in the shader. For the lab cs541. Right as it stands; each MISTAKE_… makes one of the classic mistakes.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <GL/glcorearb.h>
#include <cmath>
#include <cstdio>
#include <cstring>

static const int MAP = 256, WIDTH = 320, HEIGHT = 240;

struct Mat { float m[16]; };

static Mat product(const Mat &a, const Mat &b) {
    Mat c;
    for (int col = 0; col < 4; col++)
        for (int row = 0; row < 4; row++) {
            float sum = 0;
            for (int k = 0; k < 4; k++) sum += a.m[4 * k + row] * b.m[4 * col + k];
            c.m[4 * col + row] = sum;
        }
    return c;
}

static Mat transposed(const Mat &a) {
    Mat t;
    for (int i = 0; i < 16; i++) t.m[i] = a.m[i % 4 * 4 + i / 4];
    return t;
}

static Mat moved(float x, float y, float z, float scale) {
    return {{scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, x, y, z, 1}};
}

static Mat turned(float radians) {
    float c = std::cos(radians), s = std::sin(radians);
    return {{c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0, 0, 0, 1}};
}

// The field of view in radians.
static Mat perspective(float fov, float aspect, float near, float far) {
    float focal = 1 / std::tan(fov / 2);
    return {{focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0,
             2 * far * near / (near - far), 0}};
}

static void cross(const float *a, const float *b, float *c) {
    for (int i = 0; i < 3; i++) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalize(float *v) {
    float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++) v[i] /= length;
}

static Mat look_at(const float *eye, const float *at, const float *up) {
    float back[3], right[3], top[3];
    for (int i = 0; i < 3; i++) back[i] = eye[i] - at[i];
    normalize(back);
    cross(up, back, right);
    normalize(right);
    cross(back, right, top);
    Mat v;
    for (int i = 0; i < 3; i++) {
        v.m[4 * i] = right[i], v.m[4 * i + 1] = top[i], v.m[4 * i + 2] = back[i], v.m[4 * i + 3] = 0;
    }
    const float *rows[3] = {right, top, back};
    for (int row = 0; row < 3; row++) {
        v.m[12 + row] = 0;
        for (int i = 0; i < 3; i++) v.m[12 + row] -= rows[row][i] * eye[i];
    }
    v.m[15] = 1;
    return v;
}

static const char *shadow_vert =
    "#version 330\n"
    "in vec4 position; uniform mat4 persp_matrix, view_matrix, model_matrix;\n"
    "void main() { gl_Position = persp_matrix * view_matrix * model_matrix * position; }\n";
static const char *shadow_frag = "#version 330\nvoid main() {}\n";
static const char *lighting_vert =
    "#version 330\n"
    "in vec4 position; uniform mat4 persp_matrix, view_matrix, model_matrix;\n"
    "uniform mat4 shadow_persp_matrix, shadow_view_matrix; out vec4 vshadow_position;\n"
#ifdef MISTAKE_bias_matrix_missing
    "void main() {\n"
    "    gl_Position = persp_matrix * view_matrix * model_matrix * position;\n"
    "    vshadow_position = shadow_persp_matrix * shadow_view_matrix * model_matrix * position;\n"
#else
    "const mat4 B = mat4(0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0.5, 0.5, 0.5, 1);\n"
    "void main() {\n"
    "    gl_Position = persp_matrix * view_matrix * model_matrix * position;\n"
    "    vshadow_position = B * shadow_persp_matrix * shadow_view_matrix * model_matrix * position;\n"
#endif
    "}\n";
static const char *lighting_frag =
    "#version 330\n"
#if defined(MISTAKE_compare_mode)
    "in vec4 vshadow_position; uniform sampler2DShadow shadow_sampler; uniform sampler2D usampler;\n"
#else
    "in vec4 vshadow_position; uniform sampler2D shadow_sampler; uniform sampler2D usampler;\n"
#endif
    "uniform float epsilon; out vec4 frag_color;\n"
    "void main() {\n"
    "    vec3 place = vshadow_position.xyz / vshadow_position.w;\n"
    "    bool inside = vshadow_position.w > 0 && place == clamp(place, 0, 1);\n"
#if defined(MISTAKE_compare_mode)
    "    bool dark = inside && texture(shadow_sampler, place) < 0.5 + epsilon;\n"
#else
    "    bool dark = inside && texture(shadow_sampler, place.xy).z < place.z - epsilon;\n"
#endif
    "    frag_color = texture(usampler, place.xy) * (dark ? 0.3 : 1.0);\n"
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
    glBindAttribLocation(made, 0, "position");
    glLinkProgram(made);
    GLint linked;
    glGetProgramiv(made, GL_LINK_STATUS, &linked);
    if (!linked) puts("not linked");
    return made;
}

static void set(GLuint program, const char *name, const Mat &matrix) {
    glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, matrix.m);
}

static GLuint floor_mesh, cube_mesh;

static GLuint mesh(const float *vertices, int count) {
    GLuint vao, buffer;
    glGenVertexArrays(1, &vao);
    glBindVertexArray(vao);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, 12 * count, vertices, GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    return vao;
}

static void scene(GLuint program, float angle) {
    set(program, "model_matrix", moved(0, 0, 0, 4));
    glBindVertexArray(floor_mesh);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    set(program, "model_matrix", product(moved(0, 1, 0, .7f), turned(angle)));
    glBindVertexArray(cube_mesh);
    glDrawArrays(GL_TRIANGLES, 0, 6);
}

int main() {
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    eglInitialize(display, NULL, NULL);
    eglBindAPI(EGL_OPENGL_API);
    EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_DEPTH_SIZE, 24, EGL_NONE};
    EGLConfig config;
    EGLint count;
    eglChooseConfig(display, wanted, &config, 1, &count);
    EGLint size[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE};
    EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
                        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
    eglMakeCurrent(display, surface, surface, context);

    GLuint frame_buffer, depth_texture_buffer, stone;
    glGenFramebuffers(1, &frame_buffer);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
    glGenTextures(1, &depth_texture_buffer);
    glBindTexture(GL_TEXTURE_2D, depth_texture_buffer);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, MAP, MAP, 0, GL_DEPTH_COMPONENT, GL_FLOAT, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
#ifndef MISTAKE_no_swizzle
    GLint red[4] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, red);
#endif
#ifdef MISTAKE_attached_as_color
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, depth_texture_buffer, 0);
#else
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_texture_buffer, 0);
#endif
#ifdef MISTAKE_no_draw_buffer_none
    glDrawBuffer(GL_COLOR_ATTACHMENT0);
#else
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
#endif
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) puts("incomplete");
    glBindFramebuffer(GL_FRAMEBUFFER, 0);

    glGenTextures(1, &stone);
    glBindTexture(GL_TEXTURE_2D, stone);
    unsigned char grey[8 * 8 * 3];
    std::memset(grey, 200, sizeof grey);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, grey);
    glGenerateMipmap(GL_TEXTURE_2D);

    float square[12] = {-1, 0, -1, 1, 0, -1, -1, 0, 1, 1, 0, 1};
    float wedge[18] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, -1, -1, 0, 0, -1, 1, 0, 1, 0};
    floor_mesh = mesh(square, 4);
    cube_mesh = mesh(wedge, 6);
    GLuint shadow = program(shadow_vert, shadow_frag), lighting = program(lighting_vert, lighting_frag);
    glEnable(GL_DEPTH_TEST);

    float eye[3] = {0, 4, 8}, origin[3] = {0, 0, 0}, up[3] = {0, 1, 0};
#ifdef MISTAKE_light_along_up
    float light[3] = {0, 6, 0};
#else
    float light[3] = {3, 6, 2};
#endif
    const float radian = 3.14159265f / 180;
#ifdef MISTAKE_degrees_for_radians
    Mat light_persp = perspective(70, 1, 1, 20);
#else
    Mat light_persp = perspective(70 * radian, 1, 1, 20);
#endif
    Mat light_view = look_at(light, origin, up);

    for (int frame = 0; frame < 2; frame++) {
        // First pass.
#ifdef MISTAKE_clear_before_bind
        glClear(GL_DEPTH_BUFFER_BIT);
#endif
        glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
        glViewport(0, 0, MAP, MAP);
        glUseProgram(shadow);
#ifdef MISTAKE_cleared_to_zero
        glClearDepth(0);
#endif
#ifndef MISTAKE_clear_before_bind
        glClear(GL_DEPTH_BUFFER_BIT);
#endif
        glClearDepth(1);
#ifdef MISTAKE_depth_test_off
        glDisable(GL_DEPTH_TEST);
#endif
#ifdef MISTAKE_culling_not_reset
        glEnable(GL_CULL_FACE);
        glCullFace(GL_FRONT);
#endif
        set(shadow, "persp_matrix", light_persp);
        set(shadow, "view_matrix", light_view);
        scene(shadow, .3f * frame);
        glEnable(GL_DEPTH_TEST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);

        // Second pass.
        glViewport(0, 0, WIDTH, HEIGHT);
#ifdef MISTAKE_depth_not_cleared
        glClear(GL_COLOR_BUFFER_BIT);
#else
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
#endif
#ifdef MISTAKE_uniform_before_program
        glUseProgram(0);
        set(lighting, "shadow_persp_matrix", light_persp);
        glUseProgram(lighting);
#else
        glUseProgram(lighting);
#ifdef MISTAKE_misspelt_uniform
        set(lighting, "shadow_perps_matrix", light_persp);
#else
        set(lighting, "shadow_persp_matrix", light_persp);
#endif
#endif
        set(lighting, "persp_matrix", perspective(50 * radian, float(WIDTH) / HEIGHT, .1f, 100));
        set(lighting, "view_matrix", look_at(eye, origin, up));
#ifdef MISTAKE_row_major
        set(lighting, "shadow_view_matrix", transposed(light_view));
#else
        set(lighting, "shadow_view_matrix", light_view);
#endif
#ifdef MISTAKE_no_bias
        glUniform1f(glGetUniformLocation(lighting, "epsilon"), 0);
#else
        glUniform1f(glGetUniformLocation(lighting, "epsilon"), .002f);
#endif
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_2D, depth_texture_buffer);
#if defined(MISTAKE_same_texture_unit)
        glUniform1i(glGetUniformLocation(lighting, "shadow_sampler"), 0);
#elif defined(MISTAKE_sampler_as_float)
        glUniform1f(glGetUniformLocation(lighting, "shadow_sampler"), 1);
#else
        glUniform1i(glGetUniformLocation(lighting, "shadow_sampler"), 1);
#endif
#ifndef MISTAKE_map_overwritten
        glActiveTexture(GL_TEXTURE0);
#endif
        glBindTexture(GL_TEXTURE_2D, stone);
        glUniform1i(glGetUniformLocation(lighting, "usampler"), 0);
#ifdef MISTAKE_model_matrix_differs
        scene(lighting, .3f * frame + .1f);
#else
        scene(lighting, .3f * frame);
#endif
        if (glGetError() != GL_NO_ERROR) puts("error");
        eglSwapBuffers(display, surface);
    }
    glDeleteTextures(1, &depth_texture_buffer);
    glDeleteFramebuffers(1, &frame_buffer);
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}
