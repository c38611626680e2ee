// A shadow map in OpenGL 2.1, as programs of about 2008 do it: GLUT, EXT framebuffer objects, the fixed pipeline's
// matrices in the first pass, gl_TextureMatrix[1] for the way to the map. For the lab cmsc23700: a spotlight above
// an open box. Right as it stands; each MISTAKE_… makes one of the classic mistakes.
#define GL_GLEXT_PROTOTYPES
#include <GL/glut.h>
#include <GL/glext.h>
#include <cstdio>
#include <cstdlib>

static const int MAP = 512, WINDOW = 300;
static GLuint shadow_texture, shadow_fbo, lighting, other;
static int frames = 0;
static float angle = 0;

static const char *lighting_vert =
    "varying vec4 in_light; varying vec3 normal;\n"
    "void main() {\n"
    "    in_light = gl_TextureMatrix[1] * gl_Vertex;\n"
    "    normal = gl_NormalMatrix * gl_Normal;\n"
    "    gl_FrontColor = gl_Color;\n"
    "    gl_Position = ftransform();\n"
    "}\n";
static const char *lighting_frag =
    "uniform sampler2D picture; uniform sampler2D shadow_map; uniform float ambient;\n"
    "varying vec4 in_light; varying vec3 normal;\n"
    "void main() {\n"
    "    vec3 place = in_light.xyz / in_light.w;\n"
    "    float lit = place.z - 0.002 > texture2D(shadow_map, place.xy).x ? 0.5 : 1.0;\n"
    "    gl_FragColor = gl_Color * texture2D(picture, place.xy * 0.0) * max(ambient, lit * abs(normal.z));\n"
    "}\n";
static const char *other_frag = "void main() { gl_FragColor = vec4(1.0); }\n";

static GLuint program(const char *vert, const char *frag) {
    GLuint made = glCreateProgram();
    const char *texts[2] = {vert, frag};
    for (int i = 0; i < 2; i++) {
        if (!texts[i]) continue;
        GLuint shader = glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);
        glShaderSource(shader, 1, &texts[i], NULL);
        glCompileShader(shader);
        glAttachShader(made, shader);
    }
    glLinkProgram(made);
    return made;
}

static void init() {
    glEnable(GL_DEPTH_TEST);
    glClearColor(.2f, .2f, .4f, 1);

    glGenTextures(1, &shadow_texture);
    glBindTexture(GL_TEXTURE_2D, shadow_texture);
#ifndef MISTAKE_mipmap_filter
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
#endif
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
#ifndef MISTAKE_repeat_outside
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
#endif
#ifdef MISTAKE_compare_mode
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE_ARB);
#endif
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, MAP, MAP, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, NULL);

    glGenFramebuffersEXT(1, &shadow_fbo);
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, shadow_fbo);
#ifndef MISTAKE_no_draw_buffer_none
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
#endif
    glFramebufferTexture2DEXT(GL_FRAMEBUFFER_EXT, GL_DEPTH_ATTACHMENT_EXT, GL_TEXTURE_2D, shadow_texture, 0);
    if (glCheckFramebufferStatusEXT(GL_FRAMEBUFFER_EXT) != GL_FRAMEBUFFER_COMPLETE_EXT) puts("incomplete");
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, 0);

    GLubyte white[4] = {255, 255, 255, 255};
    GLuint picture;
    glGenTextures(1, &picture);
    glBindTexture(GL_TEXTURE_2D, picture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, white);

    lighting = program(lighting_vert, lighting_frag);
    other = program(NULL, other_frag);
#ifdef MISTAKE_other_program
    glUseProgram(other);
#else
    glUseProgram(lighting);
#endif
#ifndef MISTAKE_same_texture_unit
    glUniform1i(glGetUniformLocation(lighting, "shadow_map"), 1);
#endif
    glUseProgram(lighting);
    glUniform1i(glGetUniformLocation(lighting, "picture"), 0);
#ifdef MISTAKE_misspelt_uniform
    glUniform1f(glGetUniformLocation(lighting, "ambeint"), .3f);
#else
    glUniform1f(glGetUniformLocation(lighting, "ambient"), .3f);
#endif
    glUseProgram(0);
}

static void quad(float ax, float ay, float az, float bx, float by, float bz, float x, float y, float z) {
    glNormal3f(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
    glBegin(GL_QUADS);
    glVertex3f(x, y, z);
    glVertex3f(x + ax, y + ay, z + az);
    glVertex3f(x + ax + bx, y + ay + by, z + az + bz);
    glVertex3f(x + bx, y + by, z + bz);
    glEnd();
}

// The model matrix goes to the texture matrix as well, where the lighting shader looks for it.
static void on_both(bool second_pass, void (*transform)()) {
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    transform();
    if (second_pass) {
        glActiveTexture(GL_TEXTURE1);
        glMatrixMode(GL_TEXTURE);
        glPushMatrix();
        transform();
        glMatrixMode(GL_MODELVIEW);
        glActiveTexture(GL_TEXTURE0);
    }
}

static void off_both(bool second_pass) {
    if (second_pass) {
        glActiveTexture(GL_TEXTURE1);
        glMatrixMode(GL_TEXTURE);
        glPopMatrix();
        glActiveTexture(GL_TEXTURE0);
    }
    glMatrixMode(GL_MODELVIEW);
    glPopMatrix();
}

static void place_ball() {
    glTranslatef(.2f, -.3f, .1f);
    glRotatef(angle, 0, 1, 0);
}

static void scene(bool second_pass) {
    glColor3f(1, .25f, .25f);
    quad(2, 0, 0, 0, 0, 2, -1, -1, -1);
    glColor3f(.25f, 1, .25f);
    quad(2, 0, 0, 0, 2, 0, -1, -1, 1);
#ifdef MISTAKE_model_matrix_differs
    angle += 10; // Time goes on in both passes.
#else
    if (!second_pass) angle += 10;
#endif
    on_both(second_pass, place_ball);
    glColor3f(.8f, 1, .4f);
    glutSolidCube(.4);
    off_both(second_pass);
}

static void light_camera() {
#ifdef MISTAKE_near_too_small
    gluPerspective(60, 1, .0001, 6);
#else
    gluPerspective(60, 1, 1, 6);
#endif
    gluLookAt(.4, 3, -.8, 0, 0, 0, 0, 0, 1);
}

static void display() {
    // First pass: the depth texture.
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, shadow_fbo);
#ifndef MISTAKE_viewport_not_set
    glViewport(0, 0, MAP, MAP);
#endif
#ifdef MISTAKE_depth_mask
    glDepthMask(GL_FALSE);
#endif
#ifndef MISTAKE_map_not_cleared
    glClear(GL_DEPTH_BUFFER_BIT);
#endif
    glDepthMask(GL_TRUE);
    glUseProgram(0);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    light_camera();
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    scene(false);
#ifndef MISTAKE_framebuffer_not_restored
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, 0);
#endif

    // Second pass: the picture.
#if !defined(MISTAKE_viewport_not_restored) && !defined(MISTAKE_viewport_not_set)
    glViewport(0, 0, WINDOW, WINDOW);
#endif
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    gluPerspective(65, 1, 1.9, 4.1);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    gluLookAt(0, 0, -3, 0, 0, 0, 0, 1, 0);
    glActiveTexture(GL_TEXTURE1);
    glMatrixMode(GL_TEXTURE);
    glLoadIdentity();
#if defined(MISTAKE_bias_matrix_swapped)
    glScalef(.5f, .5f, .5f);
    glTranslatef(.5f, .5f, .5f);
#elif !defined(MISTAKE_bias_matrix_missing)
    glTranslatef(.5f, .5f, .5f);
    glScalef(.5f, .5f, .5f);
#endif
#ifdef MISTAKE_bias_matrix_twice
    glTranslatef(.5f, .5f, .5f);
    glScalef(.5f, .5f, .5f);
#endif
    light_camera();
#ifndef MISTAKE_map_not_bound
    glBindTexture(GL_TEXTURE_2D, shadow_texture);
#endif
    glMatrixMode(GL_MODELVIEW);
    glActiveTexture(GL_TEXTURE0);
    glUseProgram(lighting);
    scene(true);
    glUseProgram(0);

    // A line of text over the picture.
    glBindTexture(GL_TEXTURE_2D, 0);
    glDisable(GL_DEPTH_TEST);
    glColor3f(1, 1, 1);
    glWindowPos2i(4, 4);
    for (const char *c = "shadows"; *c; c++) glutBitmapCharacter(GLUT_BITMAP_8_BY_13, *c);
    glEnable(GL_DEPTH_TEST);
    glBindTexture(GL_TEXTURE_2D, 2);
    glutSwapBuffers();
    if (++frames == 2) exit(0);
    glutPostRedisplay();
}

static void reshape(int width, int height) {
    glViewport(0, 0, width, height);
}

int main(int argc, char **argv) {
    glutInit(&argc, argv);
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH);
    glutInitWindowSize(WINDOW, WINDOW);
    glutCreateWindow("shadows");
    init();
    glutDisplayFunc(display);
    glutReshapeFunc(reshape);
    glutMainLoop();
}
