/*
 * The Python extension module m3d_language._binding: the tree-sitter language, and the reader of big tables.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "table_reader.h"

typedef struct TSLanguage TSLanguage;
const TSLanguage *tree_sitter_m3d(void);

static PyObject *language(PyObject *module, PyObject *unused) {
    (void)module;
    (void)unused;
    return PyCapsule_New((void *)tree_sitter_m3d(), "tree_sitter.Language", NULL);
}

/* Room for as many bytes in a bytearray, or -1 with MemoryError set. */
static int resize(PyObject *bytes, size_t size) {
    if (size > PY_SSIZE_T_MAX) {
        PyErr_NoMemory();
        return -1;
    }
    return PyByteArray_Resize(bytes, (Py_ssize_t)size);
}

/* Reads all rows into two bytearrays, letting other threads run while it scans. -1 with an exception set. */
static int read_rows(TableReader *reader, PyObject *rows, PyObject *offsets, size_t offset_size) {
    size_t width = reader->row_width * sizeof(double);
    size_t room = (size_t)(reader->end - reader->at) / (8 * reader->row_width) + 16;
    const size_t most_at_once = 1 << 20;
    if (room > most_at_once) room = most_at_once;
    size_t count = 0;
    for (;;) {
        if (resize(rows, room * width) < 0 || resize(offsets, room * offset_size) < 0) return -1;
        char *to_rows = PyByteArray_AsString(rows), *to_offsets = PyByteArray_AsString(offsets);
        Py_BEGIN_ALLOW_THREADS
        count = table_reader_rows(reader, (double *)to_rows, to_offsets, offset_size, count, room);
        Py_END_ALLOW_THREADS
        if (count < room) break;
        if (PyErr_CheckSignals() < 0) return -1;
        room += room / 2;
    }
    return resize(rows, count * width) < 0 ? -1 : resize(offsets, count * offset_size);
}

/* 0, or -1 with ValueError set. */
static int check_range(const Py_buffer *source, Py_ssize_t start, Py_ssize_t end) {
    if (0 <= start && start <= end && end <= source->len) return 0;
    PyErr_SetString(PyExc_ValueError, "start and end must lie within the source, in this order");
    return -1;
}

PyDoc_STRVAR(read_table_doc,
             "read_table(source, start, end, head, row) -> (head, rows, offsets, offset_size, stopped_at, expected)\n\n"
             "See m3d_language.bulk.read_table.");

static PyObject *read_table(PyObject *module, PyObject *arguments) {
    (void)module;
    Py_buffer source;
    Py_ssize_t start, end;
    const char *head_layout, *row_layout;
    if (!PyArg_ParseTuple(arguments, "y*nnss:read_table", &source, &start, &end, &head_layout, &row_layout))
        return NULL;

    PyObject *head = NULL, *rows = NULL, *offsets = NULL, *result = NULL;
    if (check_range(&source, start, end) < 0) goto done;
    TableReader reader;
    if (!table_reader_init(&reader, source.buf, (size_t)start, (size_t)end, head_layout, row_layout)) {
        PyErr_SetString(PyExc_ValueError, "a layout is made of n and v, and that of a row is not empty");
        goto done;
    }
    size_t offset_size = (uint64_t)source.len > UINT32_MAX ? sizeof(uint64_t) : sizeof(uint32_t);
    rows = PyByteArray_FromStringAndSize(NULL, 0);
    offsets = PyByteArray_FromStringAndSize(NULL, 0);
    if (!rows || !offsets) goto done;

    double head_values[TABLE_READER_WIDEST];
    size_t head_count = 0;
    if (table_reader_head(&reader, head_values)) {
        head_count = reader.head_width;
        if (read_rows(&reader, rows, offsets, offset_size) < 0) goto done;
    }
    head = PyTuple_New((Py_ssize_t)head_count);
    if (!head) goto done;
    for (size_t i = 0; i < head_count; i++) {
        PyObject *value = PyFloat_FromDouble(head_values[i]);
        if (!value || PyTuple_SetItem(head, (Py_ssize_t)i, value) < 0) goto done;
    }
    result = Py_BuildValue("OOOnnz", head, rows, offsets, (Py_ssize_t)offset_size,
                           (Py_ssize_t)(reader.at - reader.text), reader.expected);

done:
    Py_XDECREF(head);
    Py_XDECREF(rows);
    Py_XDECREF(offsets);
    PyBuffer_Release(&source);
    return result;
}

PyDoc_STRVAR(only_numbers_doc,
             "only_numbers(source, start, end) -> bool\n\n"
             "See m3d_language.bulk.only_numbers.");

static PyObject *only_numbers(PyObject *module, PyObject *arguments) {
    (void)module;
    Py_buffer source;
    Py_ssize_t start, end;
    if (!PyArg_ParseTuple(arguments, "y*nn:only_numbers", &source, &start, &end)) return NULL;
    PyObject *result = NULL;
    if (check_range(&source, start, end) == 0) {
        const uint8_t *text = source.buf;
        bool only;
        Py_BEGIN_ALLOW_THREADS
        only = table_reader_only_numbers(text + start, text + end);
        Py_END_ALLOW_THREADS
        result = PyBool_FromLong(only);
    }
    PyBuffer_Release(&source);
    return result;
}

static PyMethodDef methods[] = {
    {"language", language, METH_NOARGS, "language() -> capsule\n\nThe tree-sitter language, for tree_sitter.Language."},
    {"only_numbers", only_numbers, METH_VARARGS, only_numbers_doc},
    {"read_table", read_table, METH_VARARGS, read_table_doc},
    {NULL, NULL, 0, NULL},
};

static int prepare(PyObject *module) {
    (void)module;
    table_reader_prepare();
    return 0;
}

static PyModuleDef_Slot slots[] = {
    {Py_mod_exec, (void *)prepare},
    {0, NULL},
};

static PyModuleDef definition = {
    .m_base = PyModuleDef_HEAD_INIT,
    .m_name = "_binding",
    .m_doc = "The tree-sitter language and the reader of big tables.",
    .m_size = 0,
    .m_methods = methods,
    .m_slots = slots,
};

PyMODINIT_FUNC PyInit__binding(void) {
    return PyModuleDef_Init(&definition);
}
