// Projected shadows in OpenGL 2.1, as the lab eecs487 has them: GLUT, glMultMatrixf with the shadow matrix, the stencil,
// glAccum; with -DFBO a framebuffer object in place of the accumulation buffer. Right as it stands; each MISTAKE_… makes
// one of the classic mistakes.
#define GL_GLEXT_PROTOTYPES
#include <GL/glut.h>
#include <GL/glext.h>
#include <cstdio>
#include <cstdlib>

static const int WINDOW = 200, JITTERS = 2;
static GLfloat light[3] = {.05f, .6f, .2f};
static const GLfloat walls[2][4] = {{0, 1, 0, 1}, {1, 0, 0, 1}}, colors[2][3] = {{.4f, .8f, .7f}, {.8f, .7f, .4f}};
static int frames = 0;

static void mult_shadow_mat(const GLfloat *plane) {
    GLfloat sign = 1, L[4] = {light[0], light[1], light[2], 1}, m[16], dot = 0;
#ifdef MISTAKE_plane_sign
    sign = -1;
#endif
    for (int i = 0; i < 4; i++) dot += sign * plane[i] * L[i];
    for (int col = 0; col < 4; col++)
        for (int row = 0; row < 4; row++) {
#ifdef MISTAKE_shadow_matrix_row_major
            int place = 4 * row + col;
#else
            int place = 4 * col + row;
#endif
            m[place] = (row == col ? dot : 0) - L[row] * sign * plane[col];
        }
    glMultMatrixf(m);
}

static void draw_wall(int wall) {
    const GLfloat corners[2][4][3] = {{{-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}},
                                      {{-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}}};
    glColor3fv(colors[wall]);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) glVertex3fv(corners[wall][i]);
    glEnd();
}

static void draw_occluders() {
    glPushMatrix();
    glRotatef(30, .7f, 1, -.2f);
    glPushMatrix();
    glTranslatef(-.3f, .16f, .1f);
    glutSolidCube(.2);
    glPopMatrix();
    glRotatef(80, 1, 1, 0);
    glutSolidTorus(.05, .35, 4, 6);
    glPopMatrix();
}

static void draw_scene() {
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
#ifndef MISTAKE_stencil_not_cleared
    glClear(GL_STENCIL_BUFFER_BIT);
#endif
    for (int wall = 0; wall < 2; wall++) {
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_ALWAYS, wall + 1, 0xff);
#ifdef MISTAKE_stencil_kept
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
#else
        glStencilOp(GL_REPLACE, GL_REPLACE, GL_REPLACE);
#endif
        draw_wall(wall);
#ifndef MISTAKE_stencil_always
        glStencilFunc(GL_EQUAL, wall + 1, 0xff);
#endif
#ifndef MISTAKE_no_polygon_offset
        glEnable(GL_POLYGON_OFFSET_FILL);
#ifdef MISTAKE_polygon_offset_away
        glPolygonOffset(1, 5);
#else
        glPolygonOffset(-1, -5);
#endif
#endif
        glColor3f(.3f * colors[wall][0], .3f * colors[wall][1], .3f * colors[wall][2]);
        glPushMatrix();
        mult_shadow_mat(walls[wall]);
        draw_occluders();
        glPopMatrix();
        glDisable(GL_POLYGON_OFFSET_FILL);
        glDisable(GL_STENCIL_TEST);
    }
    glColor3f(1, .5f, .3f);
    draw_occluders();
}

#ifdef FBO
static GLuint frame_fbo, accum_fbo, frame_texture;

static void init() {
    GLuint accumulator, depth;
    glGenTextures(1, &frame_texture);
    glBindTexture(GL_TEXTURE_2D, frame_texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, WINDOW, WINDOW, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenRenderbuffersEXT(1, &depth);
    glBindRenderbufferEXT(GL_RENDERBUFFER_EXT, depth);
    glRenderbufferStorageEXT(GL_RENDERBUFFER_EXT, GL_DEPTH24_STENCIL8, WINDOW, WINDOW);
    glGenFramebuffersEXT(1, &frame_fbo);
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, frame_fbo);
    glFramebufferTexture2DEXT(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, frame_texture, 0);
    glFramebufferRenderbufferEXT(GL_FRAMEBUFFER_EXT, GL_DEPTH_ATTACHMENT_EXT, GL_RENDERBUFFER_EXT, depth);
    glFramebufferRenderbufferEXT(GL_FRAMEBUFFER_EXT, GL_STENCIL_ATTACHMENT_EXT, GL_RENDERBUFFER_EXT, depth);
    glGenRenderbuffersEXT(1, &accumulator);
    glBindRenderbufferEXT(GL_RENDERBUFFER_EXT, accumulator);
#ifdef MISTAKE_accumulator_of_8_bits
    glRenderbufferStorageEXT(GL_RENDERBUFFER_EXT, GL_RGBA8, WINDOW, WINDOW);
#else
    glRenderbufferStorageEXT(GL_RENDERBUFFER_EXT, GL_RGBA32F, WINDOW, WINDOW);
#endif
    glGenFramebuffersEXT(1, &accum_fbo);
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, accum_fbo);
    glFramebufferRenderbufferEXT(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_RENDERBUFFER_EXT, accumulator);
    if (glCheckFramebufferStatusEXT(GL_FRAMEBUFFER_EXT) != GL_FRAMEBUFFER_COMPLETE_EXT) puts("incomplete");
}

static void begin_picture() {
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, frame_fbo);
}

static void fbo_accum_clear() {
#ifndef MISTAKE_accumulator_not_cleared
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, accum_fbo);
    glClear(GL_COLOR_BUFFER_BIT);
#endif
}

static void accumulate(float weight) {
    glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, accum_fbo);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_BLEND);
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE);
    glBlendColor(0, 0, 0, weight);
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glColor3f(1, 1, 1);
    glBegin(GL_QUADS);
    glTexCoord2f(0, 0), glVertex2f(-1, -1);
    glTexCoord2f(1, 0), glVertex2f(1, -1);
    glTexCoord2f(1, 1), glVertex2f(1, 1);
    glTexCoord2f(0, 1), glVertex2f(-1, 1);
    glEnd();
    glEnable(GL_DEPTH_TEST);
    glPopMatrix();
    glMatrixMode(GL_PROJECTION);
    glPopMatrix();
    glMatrixMode(GL_MODELVIEW);
    glDisable(GL_BLEND);
    glDisable(GL_TEXTURE_2D);
}

static void give_back() {
    glBindFramebufferEXT(GL_READ_FRAMEBUFFER_EXT, accum_fbo);
    glBindFramebufferEXT(GL_DRAW_FRAMEBUFFER_EXT, 0);
#ifndef MISTAKE_not_returned
    glBlitFramebufferEXT(0, 0, WINDOW, WINDOW, 0, 0, WINDOW, WINDOW, GL_COLOR_BUFFER_BIT, GL_NEAREST);
#endif
}
#else
static void init() {}
static void begin_picture() {}

static void fbo_accum_clear() {
#ifndef MISTAKE_accumulator_not_cleared
    glClear(GL_ACCUM_BUFFER_BIT);
#endif
}

static void accumulate(float weight) {
    glAccum(GL_ACCUM, weight);
}

static void give_back() {
#if defined(MISTAKE_sum_then_divide)
    glAccum(GL_RETURN, 1.f / JITTERS);
#elif !defined(MISTAKE_not_returned)
    glAccum(GL_RETURN, 1);
#endif
}
#endif

static void display() {
    fbo_accum_clear();
    for (int i = 0; i < JITTERS; i++) {
        begin_picture();
        light[0] += .009f;
        draw_scene();
        light[0] -= .009f;
#if defined(MISTAKE_weights_wrong) || defined(MISTAKE_sum_then_divide)
        accumulate(1);
#else
        accumulate(1.f / JITTERS);
#endif
    }
    give_back();
    glutSwapBuffers();
    if (++frames == 2) exit(0);
    glutPostRedisplay();
}

int main(int argc, char **argv) {
    glutInit(&argc, argv);
    glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH | GLUT_STENCIL | GLUT_ACCUM);
    glutInitWindowSize(WINDOW, WINDOW);
    glutCreateWindow("projected shadows");
    glEnable(GL_DEPTH_TEST);
    glClearColor(.7f, .8f, 1, 1);
    glMatrixMode(GL_PROJECTION);
    glFrustum(-1, 1, -1, 1, 2, 7);
    glMatrixMode(GL_MODELVIEW);
    glTranslatef(0, 0, -3);
    init();
    glutDisplayFunc(display);
    glutMainLoop();
}
