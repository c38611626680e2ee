//! OBJ models through tobj.
