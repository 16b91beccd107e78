// Empty: it carries the precompiled headers of the web build.
