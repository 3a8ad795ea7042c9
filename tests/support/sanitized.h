// Sanitizers have a malloc and memory of their own, and take several times as long: what a process
// takes says nothing under them.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SCANOUT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SCANOUT_SANITIZED 1
#endif
#endif
