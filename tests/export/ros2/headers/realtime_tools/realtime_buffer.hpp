namespace realtime_tools { template <typename T> struct RealtimeBuffer {
    void writeFromNonRT(const T &); T *readFromRT(); }; }
