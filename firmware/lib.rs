//! The application image: the tasks around the scan.

#![no_std]
